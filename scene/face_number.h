// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/image.h"
#include "scene/polygon_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// People, tables and pictures know a face by its number in the model's file, from 1, even where
// faces before it cannot be used and are left out. In memory a face is its place among the model's
// faces, from 0, and a label picture holds place + 1; these, and FaceNumber
// (scene/polygon_model.h), lead from one to the other.

// The face with this number; nothing if it is left out or there never was one.
std::optional<int> FindFaceByNumber(const PolygonModel& model, long long number);
int HighestFaceNumber(const PolygonModel& model);

// What to call a face: its name, with its number where other faces have that name as well, or the
// number alone: "wall south", "Haus (face 12)", "face 12".
std::string NameOfFace(const PolygonModel& model, int face);

// Label pictures with the faces' numbers, for files and people.
Image16 NumbersFromLabels(const PolygonModel& model, const Image16& labels);
// And back. `file` held the numbers: Error names it if it holds one that no face has.
Image16 LabelsFromNumbers(const PolygonModel& model,
                          const Image16& numbers,
                          const std::filesystem::path& file);
// The same for pictures of another model too: a number that no face has becomes a label that no
// face has.
Image16 KnownLabelsFromNumbers(const PolygonModel& model, const Image16& numbers);

// "1-11 13-70": the numbers of all faces in order, for formats that have no place for them; empty
// if they count from 1 without a gap.
std::string FormatFaceNumbers(const PolygonModel& model);
// Gives them back to the faces; nothing happens if there are not as many numbers as faces.
void ApplyFaceNumbers(std::string_view text, PolygonModel& model);

}  // namespace groundglass
