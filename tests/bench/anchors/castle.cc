// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/castle.h"

#include "scene/error.h"
#include "scene/formats/image_io.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <cstdio>

namespace groundglass {
namespace {

// The polygons of a VRML 2 file as ViSP's are written (IndexedFaceSet with `point [` and
// `coordIndex [`), in its own frame; those without area are left out, equal points shared.
PolygonModel ReadVrmlPolygons(const std::filesystem::path& file) {
  std::string text = ReadTextFile(file);
  for (char& c : text) {
    if (c == ',') c = ' ';
  }
  PolygonModel model;
  std::vector<Eigen::Vector3d> points;
  std::vector<int> corners;
  enum class Place { kElsewhere, kPoints, kFaces } place = Place::kElsewhere;
  bool is_face_set = false;
  std::vector<double> numbers;
  for (const TextLine& line : SplitLines(text, '#')) {
    for (const TextToken& token : line.tokens) {
      const std::string word(token.text);
      if (word == "IndexedFaceSet" || word == "IndexedLineSet") {
        is_face_set = word == "IndexedFaceSet";
      } else if (word == "point") {
        place = Place::kPoints;
        points.clear();
      } else if (word == "coordIndex") {
        place = Place::kFaces;
        corners.clear();
      }
      // "-0.03]}" is a number and the end of the list.
      const auto value = ParseNumber(word.substr(0, word.find_first_of("]}")));
      if (value && place == Place::kPoints) {
        numbers.push_back(*value);
        if (numbers.size() == 3) {
          points.emplace_back(numbers[0], numbers[1], numbers[2]);
          numbers.clear();
        }
      } else if (value && place == Place::kFaces && *value >= 0) {
        corners.push_back(static_cast<int>(*value));
      } else if (value && place == Place::kFaces) {
        Face face;
        for (const int corner : corners) {
          if (corner >= static_cast<int>(points.size())) throw Error(file, line.number, "index");
          size_t at = 0;
          while (at < model.points_in_world.size() &&
                 (model.points_in_world[at] - points[corner]).norm() > 2e-6) {
            ++at;
          }
          if (at == model.points_in_world.size()) model.points_in_world.push_back(points[corner]);
          face.points.push_back(static_cast<int>(at));
        }
        corners.clear();
        if (!is_face_set || face.points.size() < 3) continue;
        model.faces.push_back(face);
        if (ComputeFaceArea(model, static_cast<int>(model.faces.size()) - 1) < 1e-7) {
          model.faces.pop_back();
        }
      }
      if (word.find(']') != std::string::npos) place = Place::kElsewhere;
    }
  }
  return model;
}

// Turns every face towards a point: ViSP tracks a face from its front alone, the file's faces have
// two sides, and all pictures are taken from one side of the castle.
void TurnFacesTowards(const Eigen::Vector3d& eye, PolygonModel& model) {
  for (int face = 0; face < static_cast<int>(model.faces.size()); ++face) {
    const FacePlane plane = ComputeFacePlane(model, face);
    std::vector<int>& points = model.faces[face].points;
    if (plane.normal_in_world.dot(eye) < plane.offset) std::reverse(points.begin(), points.end());
  }
}

Eigen::Matrix4d ReadPose(const std::filesystem::path& file) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  const std::string text = ReadTextFile(file);
  int row = 0;
  for (const TextLine& line : SplitLines(text)) {
    if (line.tokens.size() != 4 || row == 4) continue;
    for (int column = 0; column < 4; ++column) {
      pose(row, column) = ParseNumber(line.tokens[column].text).value_or(0);
    }
    ++row;
  }
  if (row != 4) throw Error(file, "expected four rows of four numbers");
  return pose;
}

}  // namespace

AnchorSet ReadCastle(const std::filesystem::path& folder) {
  AnchorSet castle;
  castle.name = "castle";
  castle.world_from_visp << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  PolygonModel& model = castle.model;
  model = ReadVrmlPolygons(folder / "Models/chateau.wrl");
  const Eigen::Matrix4d middle_pose = ReadPose(folder / "CameraPose" / "Camera_020.txt");
  TurnFacesTowards(
      -(middle_pose.topLeftCorner<3, 3>().transpose() * middle_pose.topRightCorner<3, 1>()), model);
  model.unit = LengthUnit::kMetre;
  for (Eigen::Vector3d& point : model.points_in_world) {
    point = kWorldPerVisp * (castle.world_from_visp * point);
  }
  for (int frame = 1; frame <= 40; ++frame) {
    char number[8];
    std::snprintf(number, sizeof number, "%04d", frame);
    char short_number[8];
    std::snprintf(short_number, sizeof short_number, "%03d", frame);
    const Eigen::Matrix4d pose =
        ReadPose(folder / "CameraPose" / (std::string("Camera_") + short_number + ".txt"));
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.focal_x_px = camera.focal_y_px = 700;
    // ViSP counts pixel centres from 0: its 319.5, 239.5 is the middle of the frame.
    camera.center_x_px = 320;
    camera.center_y_px = 240;
    camera.cam_from_world.rotation =
        pose.topLeftCorner<3, 3>() * castle.world_from_visp.transpose();
    camera.cam_from_world.translation = kWorldPerVisp * pose.topRightCorner<3, 1>();
    castle.frames.push_back(
        {ReadGrey8(folder / "Images" / (std::string("Image_") + number + ".pgm")),
         TagFromCamera(camera, camera.cam_from_world.translation.norm())});
  }
  return castle;
}

}  // namespace groundglass
