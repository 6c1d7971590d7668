// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/foreign_lens.h"

#include "scene/error.h"
#include "scene/text.h"
#include "scene/view_tag.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace groundglass {

ViewTag TagOfLens(const Lens& lens) {
  ViewTag tag;
  tag.view_angle_deg = lens.view_angle_deg;
  tag.aspect = lens.aspect;
  tag.shift_x = lens.shift_x;
  tag.shift_y = lens.shift_y;
  tag.k1 = lens.k1;
  tag.k2 = lens.k2;
  tag.k3 = lens.k3;
  tag.p1 = lens.p1;
  tag.p2 = lens.p2;
  return tag;
}

namespace {

namespace fs = std::filesystem;

Lens LensOfCamera(const Camera& camera, const fs::path& file) {
  const bool is_sound = camera.width_px > 0 && camera.height_px > 0 && camera.focal_x_px > 0 &&
                        camera.focal_y_px > 0 && std::isfinite(camera.focal_x_px) &&
                        std::isfinite(camera.focal_y_px) && std::isfinite(camera.center_x_px) &&
                        std::isfinite(camera.center_y_px);
  if (!is_sound) throw Error(file, "its picture's size and focal lengths must be above 0");
  const ViewTag tag = TagFromCamera(camera, 1);
  Lens lens;
  lens.view_angle_deg = tag.view_angle_deg;
  lens.aspect = tag.aspect;
  lens.shift_x = tag.shift_x;
  lens.shift_y = tag.shift_y;
  lens.k1 = tag.k1;
  lens.k2 = tag.k2;
  lens.k3 = tag.k3;
  lens.p1 = tag.p1;
  lens.p2 = tag.p2;
  return lens;
}

Camera CameraOfLens(const Lens& lens, int width_px, int height_px) {
  return CameraFromTag(TagOfLens(lens), width_px, height_px);
}

// The number or the list of numbers behind a YAML key, from a place in the text on; a list may run
// over lines, and stand below `data:`.
std::vector<double> NumbersBehind(const std::string& text,
                                  const std::string& key,
                                  size_t from = 0) {
  const size_t at = text.find(key + ":", from);
  if (at == std::string::npos) return {};
  size_t begin = at + key.size() + 1;
  const size_t line_end = std::min(text.find('\n', begin), text.size());
  size_t end = line_end;
  const std::string rest(TrimBlanks(text.substr(begin, line_end - begin)));
  if (rest.empty() || rest.starts_with("!!")) {
    const size_t data = text.find("data:", begin);
    if (data == std::string::npos) return {};
    begin = data + 5;
    end = std::min(text.find('\n', begin), text.size());
  }
  const size_t open = text.find('[', begin);
  if (open != std::string::npos && open < text.find_first_not_of(" \t\r\n", begin) + 1) {
    begin = open + 1;
    end = std::min(text.find(']', begin), text.size());
  }
  std::vector<double> numbers;
  std::string words = text.substr(begin, end - begin);
  std::replace(words.begin(), words.end(), ',', ' ');
  for (const TextLine& line : SplitLines(words, '#')) {
    for (const TextToken& token : line.tokens) {
      if (const std::optional<double> number = ParseNumber(token.text)) numbers.push_back(*number);
    }
  }
  return numbers;
}

void SetDistortion(const std::vector<double>& k1_k2_p1_p2_k3,
                   const fs::path& file,
                   Camera& camera) {
  const auto at = [&](size_t i) { return i < k1_k2_p1_p2_k3.size() ? k1_k2_p1_p2_k3[i] : 0; };
  camera.k1 = at(0);
  camera.k2 = at(1);
  camera.p1 = at(2);
  camera.p2 = at(3);
  camera.k3 = at(4);
  for (size_t i = 5; i < k1_k2_p1_p2_k3.size(); ++i) {
    if (at(i) != 0) {
      throw Error(file, "its lens has more than k1 k2 p1 p2 k3, which is not known here");
    }
  }
}

// Refuses lens models that are not a polynomial's, as these programs call them.
void RequirePolynomial(const std::string& text, const fs::path& file) {
  for (const char* model :
       {"equidistant", "fisheye", "rational_polynomial", "omni", "fov", "eucm"}) {
    const size_t at = text.find("_model:");
    if (at != std::string::npos && text.find(model, at) != std::string::npos) {
      throw Error(file, std::string("its lens model ") + model + " is not known here");
    }
  }
}

// OpenCV's and ROS'.
Lens ReadMatrixYaml(const std::string& text, const fs::path& file) {
  RequirePolynomial(text, file);
  const std::vector<double> width = NumbersBehind(text, "image_width");
  const std::vector<double> height = NumbersBehind(text, "image_height");
  const size_t matrix_at = text.find("camera_matrix:");
  const std::vector<double> matrix = NumbersBehind(text, "camera_matrix", matrix_at);
  if (width.size() != 1 || height.size() != 1) {
    throw Error(file, "image_width and image_height are missing; add the pictures' size in pixels");
  }
  if (matrix.size() != 9) throw Error(file, "camera_matrix needs 9 numbers");
  Camera camera;
  camera.width_px = static_cast<int>(width[0]);
  camera.height_px = static_cast<int>(height[0]);
  camera.focal_x_px = matrix[0];
  camera.focal_y_px = matrix[4];
  camera.center_x_px = matrix[2] + 0.5;
  camera.center_y_px = matrix[5] + 0.5;
  SetDistortion(NumbersBehind(text, "distortion_coefficients"), file, camera);
  return LensOfCamera(camera, file);
}

Lens ReadKalibrYaml(const std::string& text, const fs::path& file) {
  if (text.find("cam1:") != std::string::npos) {
    throw Error(file, "it has several cameras; leave one in it");
  }
  RequirePolynomial(text, file);
  const std::vector<double> intrinsics = NumbersBehind(text, "intrinsics");
  const std::vector<double> size = NumbersBehind(text, "resolution");
  if (intrinsics.size() != 4 || size.size() != 2) {
    throw Error(file, "expected intrinsics of a pinhole camera (4 numbers) and resolution (2)");
  }
  Camera camera;
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
  camera.focal_x_px = intrinsics[0];
  camera.focal_y_px = intrinsics[1];
  camera.center_x_px = intrinsics[2] + 0.5;
  camera.center_y_px = intrinsics[3] + 0.5;
  SetDistortion(NumbersBehind(text, "distortion_coeffs"), file, camera);
  return LensOfCamera(camera, file);
}

// COLMAP's models whose distortion is a polynomial, and which number each parameter is.
struct ColmapLens {
  std::string_view name;
  std::vector<double Camera::*> parameters;  // `f` alone sets focal_x_px first
  bool has_one_focal;
};

const std::vector<ColmapLens>& ColmapLenses() {
  static const std::vector<ColmapLens> lenses = {
      {"SIMPLE_PINHOLE", {&Camera::focal_x_px, &Camera::center_x_px, &Camera::center_y_px}, true},
      {"PINHOLE",
       {&Camera::focal_x_px, &Camera::focal_y_px, &Camera::center_x_px, &Camera::center_y_px},
       false},
      {"SIMPLE_RADIAL",
       {&Camera::focal_x_px, &Camera::center_x_px, &Camera::center_y_px, &Camera::k1},
       true},
      {"RADIAL",
       {&Camera::focal_x_px, &Camera::center_x_px, &Camera::center_y_px, &Camera::k1, &Camera::k2},
       true},
      {"OPENCV",
       {&Camera::focal_x_px,
        &Camera::focal_y_px,
        &Camera::center_x_px,
        &Camera::center_y_px,
        &Camera::k1,
        &Camera::k2,
        &Camera::p1,
        &Camera::p2},
       false}};
  return lenses;
}

// The lines of cameras.txt that are cameras: ID MODEL WIDTH HEIGHT PARAMETERS.
std::vector<TextLine> ColmapCameraLines(const std::string& text) {
  std::vector<TextLine> lines = SplitLines(text, '#');
  std::erase_if(lines, [](const TextLine& line) { return line.tokens.empty(); });
  return lines;
}

bool IsColmapCamera(const TextLine& line) {
  return line.tokens.size() >= 7 && ParseInteger(line.tokens[0].text) &&
         ParseInteger(line.tokens[2].text) && ParseInteger(line.tokens[3].text) &&
         !ParseNumber(line.tokens[1].text);
}

Lens ReadColmapCamera(const std::vector<TextLine>& lines, const fs::path& file) {
  if (lines.size() > 1) throw Error(file, "it has several cameras; leave one in it");
  const std::vector<TextToken>& words = lines.front().tokens;
  const int line_number = lines.front().number;
  for (const ColmapLens& model : ColmapLenses()) {
    if (model.name != words[1].text) continue;
    Camera camera;
    camera.width_px = static_cast<int>(*ParseInteger(words[2].text));
    camera.height_px = static_cast<int>(*ParseInteger(words[3].text));
    if (words.size() != 4 + model.parameters.size()) {
      throw Error(file,
                  line_number,
                  std::string(model.name) + " has " + std::to_string(model.parameters.size()) +
                      " parameters");
    }
    for (size_t i = 0; i < model.parameters.size(); ++i) {
      const std::optional<double> number = ParseNumber(words[4 + i].text);
      if (!number || !std::isfinite(*number)) {
        throw Error(file, line_number, Quote(words[4 + i].text) + " is not a finite number");
      }
      camera.*(model.parameters[i]) = *number;
    }
    if (model.has_one_focal) camera.focal_y_px = camera.focal_x_px;
    return LensOfCamera(camera, file);
  }
  throw Error(file,
              line_number,
              "camera model " + Quote(words[1].text) +
                  " is not known here; expected SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL or "
                  "OPENCV");
}

std::string List(std::initializer_list<double> numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    text += (text.size() == 1 ? "" : ", ") + FormatNumber(number);
  }
  return text + "]";
}

std::string FormatColmap(const Camera& camera) {
  std::string text =
      "# Camera list with one line of data per camera:\n#   CAMERA_ID, MODEL, WIDTH, "
      "HEIGHT, PARAMS[]\n1 OPENCV " +
      std::to_string(camera.width_px) + " " + std::to_string(camera.height_px);
  for (const double number : {camera.focal_x_px,
                              camera.focal_y_px,
                              camera.center_x_px,
                              camera.center_y_px,
                              camera.k1,
                              camera.k2,
                              camera.p1,
                              camera.p2}) {
    text += " " + FormatNumber(number);
  }
  return text + "\n";
}

std::string FormatMatrixYaml(const Camera& camera, const std::string& name, bool is_ros) {
  const std::string matrix = List({camera.focal_x_px,
                                   0,
                                   camera.center_x_px - 0.5,
                                   0,
                                   camera.focal_y_px,
                                   camera.center_y_px - 0.5,
                                   0,
                                   0,
                                   1});
  const std::string distortion = List({camera.k1, camera.k2, camera.p1, camera.p2, camera.k3});
  const std::string size = "image_width: " + std::to_string(camera.width_px) +
                           "\nimage_height: " + std::to_string(camera.height_px) + "\n";
  if (is_ros) {
    return size + "camera_name: " + name +
           "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: " + matrix +
           "\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: 5\n" +
           "  data: " + distortion +
           "\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
           "projection_matrix:\n  rows: 3\n  cols: 4\n  data: " +
           List({camera.focal_x_px,
                 0,
                 camera.center_x_px - 0.5,
                 0,
                 0,
                 camera.focal_y_px,
                 camera.center_y_px - 0.5,
                 0,
                 0,
                 0,
                 1,
                 0}) +
           "\n";
  }
  return "%YAML:1.0\n---\n" + size +
         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: " + matrix +
         "\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: " +
         distortion + "\n";
}

std::string FormatKalibr(const Camera& camera) {
  return "cam0:\n  camera_model: pinhole\n  distortion_coeffs: " +
         List({camera.k1, camera.k2, camera.p1, camera.p2}) +
         "\n  distortion_model: radtan\n  intrinsics: " +
         List({camera.focal_x_px,
               camera.focal_y_px,
               camera.center_x_px - 0.5,
               camera.center_y_px - 0.5}) +
         "\n  resolution: [" + std::to_string(camera.width_px) + ", " +
         std::to_string(camera.height_px) + "]\n";
}

}  // namespace

std::optional<Lens> ReadForeignLens(const std::string& text, const fs::path& file) {
  if (text.find("camera_matrix:") != std::string::npos) return ReadMatrixYaml(text, file);
  if (text.find("intrinsics:") != std::string::npos) return ReadKalibrYaml(text, file);
  const std::vector<TextLine> lines = ColmapCameraLines(text);
  if (!lines.empty() && IsColmapCamera(lines.front())) return ReadColmapCamera(lines, file);
  return std::nullopt;
}

std::string FormatForeignLens(const Lens& lens, LensFormat format, int width_px, int height_px) {
  const Camera camera = CameraOfLens(lens, width_px, height_px);
  const bool has_k3 = format == LensFormat::kOpenCv || format == LensFormat::kRos;
  if (lens.k3 != 0 && !has_k3) {
    throw Error("this format has no place for the lens' k3; opencv and ros have");
  }
  switch (format) {
    case LensFormat::kColmap:
      return FormatColmap(camera);
    case LensFormat::kKalibr:
      return FormatKalibr(camera);
    case LensFormat::kOpenCv:
    case LensFormat::kRos:
      break;
  }
  return FormatMatrixYaml(
      camera, lens.name.empty() ? "camera" : lens.name, format == LensFormat::kRos);
}

}  // namespace groundglass
