// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
//
// MeshLab's project: cnr-isti-vclab/vcglib, wrap/qt/shot_qt.h and vcg/math/camera.ipp.
#include "exchange/formats.h"
#include "exchange/rules.h"
#include "exchange/xml_reader.h"
#include "scene/error.h"
#include "scene/formats/xml_text.h"
#include "scene/text.h"

#include <string>
#include <vector>

namespace groundglass {
namespace {

// A film that wide stands for the picture's width.
constexpr double kFilmWidthMm = 36;

std::string Words(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " ") + FormatNumber(value + 0.0);
  }
  return text;
}

std::string MeshLabRaster(const ExchangeCamera& each, const std::filesystem::path& folder) {
  const Camera& camera = each.camera;
  const Eigen::Vector3d position = camera.PositionInWorld();
  const Eigen::Matrix3d gl_cam_from_world = GlFromCam() * camera.cam_from_world.rotation;
  const Eigen::Vector2d center = CenterFromBelow(camera);
  const double pixel_mm = kFilmWidthMm / camera.width_px;
  std::string rotation;
  for (int row = 0; row < 3; ++row) {
    rotation +=
        Words(
            {gl_cam_from_world(row, 0), gl_cam_from_world(row, 1), gl_cam_from_world(row, 2), 0}) +
        " ";
  }
  std::string text =
      "  <MLRaster label=\"" + XmlEscaped(each.name) + "\">\n   <VCGCamera TranslationVector=\"" +
      Words({-position.x(), -position.y(), -position.z(), 1}) +
      "\" LensDistortion=\"0 0\" ViewportPx=\"" +
      Words({1.0 * camera.width_px, 1.0 * camera.height_px}) + "\" PixelSizeMm=\"" +
      Words({pixel_mm, pixel_mm * camera.focal_x_px / camera.focal_y_px}) + "\" CenterPx=\"" +
      Words({center.x(), center.y()}) + "\" FocalMm=\"" + Words({camera.focal_x_px * pixel_mm}) +
      "\" RotationMatrix=\"" + rotation + "0 0 0 1\" CameraType=\"0\"/>\n";
  if (!each.image_file.empty()) {
    text += "   <Plane semantic=\"1\" fileName=\"" +
            XmlEscaped(each.image_file.lexically_proximate(folder).generic_string()) + "\"/>\n";
  }
  return text + "  </MLRaster>\n";
}

class MeshLabReader {
 public:
  MeshLabReader(const std::filesystem::path& file, const XmlElement& camera)
      : file_(file), camera_(camera) {}

  std::vector<double> Numbers(const std::string& attribute, size_t count) const {
    std::vector<double> numbers = ReadXmlNumbers(file_, camera_, camera_.Attribute(attribute));
    if (numbers.size() != count) {
      throw Error(file_,
                  camera_.line,
                  "<VCGCamera>: " + attribute + " has " + std::to_string(numbers.size()) +
                      " numbers, not " + std::to_string(count));
    }
    return numbers;
  }

  Camera Read() const {
    if (camera_.Attribute("CameraType") == "1") {
      throw Error("<VCGCamera> is orthographic (CameraType 1), which no photograph is");
    }
    const std::vector<double> position = Numbers("TranslationVector", 4);
    const std::vector<double> rotation = Numbers("RotationMatrix", 16);
    const std::vector<double> size = Numbers("ViewportPx", 2);
    const std::vector<double> pixel_mm = Numbers("PixelSizeMm", 2);
    const std::vector<double> center = Numbers("CenterPx", 2);
    const double focal_mm = Numbers("FocalMm", 1)[0];
    Camera camera;
    SetSize(size[0], size[1], camera);
    camera.focal_x_px = focal_mm / pixel_mm[0];
    camera.focal_y_px = focal_mm / pixel_mm[1];
    SetCenterFromBelow({center[0], center[1]}, camera);
    Eigen::Matrix4d world_from_gl_cam = Eigen::Matrix4d::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        world_from_gl_cam(column, row) = rotation[static_cast<size_t>(4 * row + column)];
      }
      world_from_gl_cam(row, 3) = -position[static_cast<size_t>(row)];
    }
    SetPoseFromGlCam(world_from_gl_cam, camera);
    return camera;
  }

 private:
  const std::filesystem::path& file_;
  const XmlElement& camera_;
};

ForeignCamera ReadRaster(const std::filesystem::path& file, const XmlElement& raster) {
  const XmlElement* plane = raster.Child("Plane");
  const std::string picture = plane ? plane->Attribute("fileName") : std::string();
  const XmlElement* camera = raster.Child("VCGCamera");
  return ReadForeignCamera(file,
                           picture.empty() ? raster.Attribute("label") : picture,
                           XmlPlace(file, camera ? *camera : raster),
                           [&] {
                             if (camera == nullptr) throw Error("<MLRaster> has no <VCGCamera>");
                             return MeshLabReader(file, *camera).Read();
                           });
}

// A mesh that the project moves stands elsewhere than its file says, and so do the cameras; unless
// another stays where it is.
void RefuseMovedMeshes(const std::filesystem::path& file, const XmlElement& project) {
  int num_in_place = 0;
  int moved_line = 0;
  const auto look_at = [&](const auto& self, const XmlElement& element) -> void {
    if (element.name == "MLMatrix44") {
      const std::vector<double> numbers = ReadXmlNumbers(file, element, element.text);
      bool is_identity = true;
      for (size_t i = 0; i < numbers.size(); ++i) {
        is_identity = is_identity && numbers[i] == (i % 5 == 0 ? 1 : 0);
      }
      if (is_identity) ++num_in_place;
      if (!is_identity && moved_line == 0) moved_line = element.line;
    }
    for (const XmlElement& child : element.children) self(self, child);
  };
  look_at(look_at, project);
  if (moved_line == 0 || num_in_place > 0) return;
  throw Error(file,
              moved_line,
              "the project moves its mesh (MLMatrix44), so that the cameras do not suit the mesh's "
              "own file; in MeshLab apply 'Matrix: Freeze Current Matrix', and save mesh and "
              "project anew");
}

void CollectRasters(const std::filesystem::path& file,
                    const XmlElement& element,
                    std::vector<ForeignCamera>& cameras) {
  if (element.name == "MLRaster") cameras.push_back(ReadRaster(file, element));
  for (const XmlElement& child : element.children) CollectRasters(file, child, cameras);
}

}  // namespace

std::vector<FileToWrite> FormatMeshLab(const ExchangeScene& scene,
                                       const std::filesystem::path& out) {
  const std::filesystem::path folder = out.parent_path();
  std::string text = "<!DOCTYPE MeshLabDocument>\n<MeshLabProject>\n <MeshGroup>\n";
  if (!scene.model_file.empty()) {
    const std::string model = scene.model_file.lexically_proximate(folder).generic_string();
    text += "  <MLMesh label=\"model\" filename=\"" + XmlEscaped(model) +
            "\">\n   <MLMatrix44>\n1 0 0 0 \n0 1 0 0 \n0 0 1 0 \n0 0 0 1 \n</MLMatrix44>\n"
            "  </MLMesh>\n";
  }
  text += " </MeshGroup>\n <RasterGroup>\n";
  for (const ExchangeCamera& camera : scene.cameras) text += MeshLabRaster(camera, folder);
  return {{out, text + " </RasterGroup>\n</MeshLabProject>\n"}};
}

std::vector<ForeignCamera> ReadMeshLab(const std::filesystem::path& file) {
  std::vector<ForeignCamera> cameras;
  const XmlElement project = ReadXml(file);
  RefuseMovedMeshes(file, project);
  CollectRasters(file, project, cameras);
  if (cameras.empty()) throw Error(file, "has no <MLRaster>, and so no camera");
  return cameras;
}

}  // namespace groundglass
