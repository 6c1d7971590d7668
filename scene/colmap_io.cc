// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/colmap_io.h"

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/text.h"
#include "scene/view_io.h"

#include <cmath>
#include <map>
#include <set>

namespace groundglass {
namespace {

// How COLMAP's model of each name fills our camera: indices into its parameters, -1 for none.
struct ModelLayout {
  size_t num_parameters;
  int focal_x, focal_y, center_x, center_y, k1, k2, p1, p2;
};
const std::map<std::string, ModelLayout, std::less<>> kLayouts = {
    {"SIMPLE_PINHOLE", {3, 0, 0, 1, 2, -1, -1, -1, -1}},
    {"PINHOLE", {4, 0, 1, 2, 3, -1, -1, -1, -1}},
    {"SIMPLE_RADIAL", {4, 0, 0, 1, 2, 3, -1, -1, -1}},
    {"RADIAL", {5, 0, 0, 1, 2, 3, 4, -1, -1}},
    {"OPENCV", {8, 0, 1, 2, 3, 4, 5, 6, 7}},
};

// One line's words, read one after the other.
class FieldReader {
 public:
  FieldReader(const std::filesystem::path& file, const TextLine& line) : file_(file), line_(line) {}

  std::string_view ReadWord(const char* what) {
    if (next_ == line_.tokens.size()) Fail(std::string("expected ") + what);
    return line_.tokens[next_++].text;
  }
  double ReadNumber(const char* what) {
    const std::string_view word = ReadWord(what);
    const std::optional<double> value = ParseNumber(word);
    if (!value || !std::isfinite(*value)) {
      Fail(std::string(what) + ": " + Quote(word) + " is not a finite number");
    }
    return *value;
  }
  long long ReadInteger(const char* what) {
    const std::string_view word = ReadWord(what);
    const std::optional<long long> value = ParseInteger(word);
    if (!value) Fail(std::string(what) + ": " + Quote(word) + " is not a whole number");
    return *value;
  }
  // The rest of the line: names may hold blanks.
  std::string ReadRest(const char* what) {
    const std::string_view first = ReadWord(what);
    const std::string_view last = line_.tokens.back().text;
    next_ = line_.tokens.size();
    return std::string(first.data(), static_cast<size_t>(last.data() + last.size() - first.data()));
  }
  size_t NumLeft() const { return line_.tokens.size() - next_; }
  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(file_, line_.number, message);
  }

 private:
  std::filesystem::path file_;
  const TextLine& line_;
  size_t next_ = 0;
};

std::map<long long, Camera> ReadCameras(const std::filesystem::path& file) {
  std::map<long long, Camera> cameras;
  const std::string text = ReadTextFile(file);
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    FieldReader fields(file, line);
    const long long id = fields.ReadInteger("camera number");
    const std::string_view model = fields.ReadWord("camera model");
    const auto layout = kLayouts.find(model);
    if (layout == kLayouts.end()) {
      fields.Fail("camera model " + Quote(model) +
                  " is not read; expected SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL or "
                  "OPENCV (colmap image_undistorter makes PINHOLE of any)");
    }
    Camera camera;
    const long long width = fields.ReadInteger("width");
    const long long height = fields.ReadInteger("height");
    constexpr long long kLongestSide = 1 << 17;
    if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide) {
      fields.Fail("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels cannot be");
    }
    camera.width_px = static_cast<int>(width);
    camera.height_px = static_cast<int>(height);
    if (fields.NumLeft() != layout->second.num_parameters) {
      fields.Fail(std::string(model) + " has " + std::to_string(layout->second.num_parameters) +
                  " parameters, not " + std::to_string(fields.NumLeft()));
    }
    std::vector<double> values;
    while (fields.NumLeft() > 0) values.push_back(fields.ReadNumber("camera parameter"));
    const auto value = [&](int index) {
      return index < 0 ? 0.0 : values[static_cast<size_t>(index)];
    };
    camera.focal_x_px = value(layout->second.focal_x);
    camera.focal_y_px = value(layout->second.focal_y);
    camera.center_x_px = value(layout->second.center_x);
    camera.center_y_px = value(layout->second.center_y);
    camera.k1 = value(layout->second.k1);
    camera.k2 = value(layout->second.k2);
    if (!(camera.focal_x_px > 0 && camera.focal_y_px > 0)) {
      fields.Fail("the focal length must be above 0");
    }
    if (value(layout->second.p1) != 0 || value(layout->second.p2) != 0) {
      fields.Fail("tangential distortion (p1, p2) is not supported");
    }
    if (!cameras.emplace(id, camera).second) {
      fields.Fail("camera " + std::to_string(id) + " is repeated");
    }
  }
  return cameras;
}

std::string FormatQuaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  return FormatNumber(q.w()) + " " + FormatNumber(q.x()) + " " + FormatNumber(q.y()) + " " +
         FormatNumber(q.z());
}

}  // namespace

void WriteColmapModel(const std::filesystem::path& folder,
                      const std::vector<NamedCamera>& cameras) {
  std::string cameras_text =
      "# CAMERA_ID MODEL WIDTH HEIGHT FX FY CX CY K1 K2 P1 P2; pixel centres at 0.5\n";
  std::string images_text =
      "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of points (none); "
      "world: x east, y north, z up\n";
  // COLMAP's database numbers the images of a folder by the byte order of their names, and its
  // point_triangulator (3.8) wants a model to have the same numbers.
  std::map<std::string, int> id_of_name;
  for (const NamedCamera& named : cameras) {
    if (!id_of_name.emplace(named.name, 0).second) {
      throw Error(folder, "two images are called " + Quote(named.name));
    }
  }
  int last_id = 0;
  for (auto& [name, id] : id_of_name) id = ++last_id;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i].camera;
    const std::string id = std::to_string(id_of_name.at(cameras[i].name));
    cameras_text +=
        id + " OPENCV " + std::to_string(camera.width_px) + " " + std::to_string(camera.height_px);
    for (const double value : {camera.focal_x_px,
                               camera.focal_y_px,
                               camera.center_x_px,
                               camera.center_y_px,
                               camera.k1,
                               camera.k2}) {
      cameras_text += " " + FormatNumber(value);
    }
    cameras_text += " 0 0\n";
    images_text += id + " " + FormatQuaternion(camera.cam_from_world.rotation);
    for (const double value : camera.cam_from_world.translation) {
      images_text += " " + FormatNumber(value);
    }
    images_text += " " + id + " " + cameras[i].name + "\n\n";
  }
  WriteFileAtomically(folder / "cameras.txt", cameras_text);
  WriteFileAtomically(folder / "images.txt", images_text);
  WriteFileAtomically(folder / "points3D.txt", "# no points\n");
}

std::vector<NamedCamera> ReadColmapModel(const std::filesystem::path& folder) {
  const std::map<long long, Camera> cameras = ReadCameras(folder / "cameras.txt");
  const std::filesystem::path file = folder / "images.txt";
  const std::string text = ReadTextFile(file);
  std::vector<NamedCamera> named_cameras;
  std::set<std::string> names;
  // Every image has two lines, the second (its points) often empty.
  bool is_points_line = false;
  for (const TextLine& line : SplitLines(text, '\0')) {
    if (is_points_line) {
      if (line.tokens.size() % 3 != 0) {
        throw Error(
            file, line.number, "expected the image's points (X Y POINT3D_ID ...) or an empty line");
      }
      is_points_line = false;
      continue;
    }
    if (line.tokens.empty() || line.tokens.front().text.front() == '#') continue;
    is_points_line = true;
    FieldReader fields(file, line);
    fields.ReadInteger("image number");
    Eigen::Quaterniond rotation;
    rotation.w() = fields.ReadNumber("QW");
    rotation.x() = fields.ReadNumber("QX");
    rotation.y() = fields.ReadNumber("QY");
    rotation.z() = fields.ReadNumber("QZ");
    Eigen::Vector3d translation;
    translation.x() = fields.ReadNumber("TX");
    translation.y() = fields.ReadNumber("TY");
    translation.z() = fields.ReadNumber("TZ");
    const long long camera_id = fields.ReadInteger("camera number");
    const std::string name = fields.ReadRest("image name");
    if (!(rotation.norm() > 1e-6)) fields.Fail("the quaternion is zero");
    const auto camera = cameras.find(camera_id);
    if (camera == cameras.end()) {
      fields.Fail("camera " + std::to_string(camera_id) + " is not in cameras.txt");
    }
    if (!names.insert(name).second) fields.Fail("image " + Quote(name) + " is repeated");
    NamedCamera& named = named_cameras.emplace_back();
    named.name = name;
    named.camera = camera->second;
    named.camera.cam_from_world = {rotation.normalized().toRotationMatrix(), translation};
  }
  if (named_cameras.empty()) throw Error(file, "no images in this model");
  return named_cameras;
}

}  // namespace groundglass
