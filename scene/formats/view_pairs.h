// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to scene.
#pragma once

#include "scene/text.h"
#include "scene/view_tag.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// A view file as it was read: its keys with their values, and where they stand.

constexpr std::string_view kCameraKey = "camera";
// x y z i j k a v, the first of kTagKeyNames: without them there is no camera.
constexpr int kNumRequiredKeys = 8;

std::optional<TagKey> FindTagKey(std::string_view name);
const SigmaKey* FindSigmaKey(std::string_view name);  // null if there is no such key

struct KeyValue {
  TextToken key;
  TextToken value;
};
const KeyValue* FindPair(const std::vector<KeyValue>& pairs, std::string_view key);

struct ViewReading {
  ViewTag tag;
  std::vector<TextLine> lines;
  std::vector<KeyValue> pairs;
  std::vector<std::string> faults;  // in the order of the file
};

// Reads everything that it can; lines and pairs point into the text. `name` stands for the file in
// faults.
ViewReading ReadPairs(const std::string& text, const std::filesystem::path& name);
// The same of a file that need not have all the keys that make a camera.
// A view file's text; throws Error that says what a file is that holds no text.
std::string ReadViewText(const std::filesystem::path& file);
ViewReading ReadSomePairs(const std::string& text, const std::filesystem::path& name);

}  // namespace groundglass
