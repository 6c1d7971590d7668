// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/camera_exchange.h"

#include "exchange/export_folder.h"
#include "exchange/formats.h"
#include "exchange/geodetic.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/colmap_io.h"
#include "scene/formats/colmap_names.h"
#include "scene/formats/given_cameras.h"
#include "scene/formats/image_io.h"
#include "scene/formats/image_paths.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

void RequireNoInput(const ExchangeSource& source, const fs::path& out) {
  for (const fs::path& file : source.files) RequireOtherFile(file, out);
}

// A camera for the picture as it is read, and what a format makes of it.
class CameraPreparation {
 public:
  CameraPreparation(const CameraFormat& format, const ExchangeSource& source, const fs::path& out)
      : format_(format), source_(source), folder_(format.is_folder ? out : out.parent_path()) {
    // Several files may lie in one folder, each with the pictures that its format needs.
    if (!format.is_folder) prefix_ = out.stem().string() + "_" + std::string(format.name) + "_";
  }

  ExchangeCamera Prepare(const NamedCamera& named, const std::string& name) {
    ExchangeCamera each = {name, named.name, named.camera, {}};
    const fs::path file = source_.images / named.name;
    const bool is_there = !source_.images.empty() && fs::is_regular_file(file);
    ImageSize size;
    if (is_there) {
      size = ReadImageSize(file);
      each.camera = FitCamera(named.camera, size, file).camera;
      each.image_file = fs::absolute(file);
    }
    const Camera prepared = PreparedCamera(each.camera, format_.needs);
    const bool is_changed = !IsSameFrame(prepared, each.camera);
    if ((is_changed || format_.keeps_pictures) && !is_there) {
      throw Error(source_.images.empty() ? fs::path(named.name) : file,
                  std::string("no such picture, and ") + std::string(format_.name) +
                      (is_changed ? " needs it changed, since it cannot hold its camera as it is"
                                  : " keeps pictures beside its cameras") +
                      "; say with --images where the photographs are");
    }
    if (is_changed || format_.keeps_pictures) RequireOwnFolder();
    if (is_changed) {
      WriteChanged(file, prepared, each);
      ++num_changed_;
    } else if (format_.keeps_pictures) {
      WriteCopy(file, size, each);
    }
    return each;
  }

  int NumChanged() const { return num_changed_; }

 private:
  fs::path PictureFile(const std::string& name) const {
    return (format_.keeps_pictures ? folder_ : folder_ / (prefix_ + "images")) / (name + ".jpg");
  }

  // Originals are never written, neither photographs nor the masks that lie beside their folder.
  void RequireOwnFolder() const {
    const fs::path photographs = fs::weakly_canonical(fs::absolute(source_.images));
    const fs::path out = fs::weakly_canonical(fs::absolute(folder_));
    if (out != photographs && out != photographs.parent_path()) return;
    throw Error(out,
                "the pictures that " + std::string(format_.name) +
                    " needs would be written among the photographs or their masks; give an output "
                    "in a folder of its own");
  }

  void WriteChanged(const fs::path& file, const Camera& prepared, ExchangeCamera& each) const {
    const PreparedImage image = PrepareImage(ReadSrgb8(file), each.camera, prepared);
    each.camera = prepared;
    each.image_file = fs::absolute(PictureFile(each.name));
    each.image_name = each.image_file.filename().string();
    WriteSrgb8(each.image_file, image.srgb8);
    WriteSrgb8(folder_ / (prefix_ + "masks") / (each.name + ".png"), image.mask);
  }

  // As it is if it is a JPEG that nobody turns.
  void WriteCopy(const fs::path& file, const ImageSize& size, ExchangeCamera& each) const {
    each.image_file = fs::absolute(PictureFile(each.name));
    const std::string ending = LowerCase(file.extension().string());
    if ((ending == ".jpg" || ending == ".jpeg") && size.orientation == 1) {
      WriteFileAtomically(each.image_file, ReadFileBytes(file));
    } else {
      WriteSrgb8(each.image_file, ReadSrgb8(file));
    }
    each.image_name = each.image_file.filename().string();
  }

  const CameraFormat& format_;
  const ExchangeSource& source_;
  fs::path folder_;
  std::string prefix_;  // of the folders of pictures and masks
  int num_changed_ = 0;
};

std::vector<std::string> NamesOf(const ExchangeSource& source) {
  std::vector<std::string> images;
  for (const NamedCamera& named : source.cameras) images.push_back(named.name);
  return NamePhotographs(images);
}

std::string CountOf(size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> CameraFormatNames() {
  std::vector<std::string> names;
  for (const CameraFormat& format : CameraFormats()) names.emplace_back(format.name);
  return names;
}

std::string DescribeCameraFormats() {
  std::string text;
  for (const CameraFormat& format : CameraFormats()) {
    text += "  " + std::string(format.name) + std::string(20 - format.name.size(), ' ') +
            std::string(format.makes) + (format.read ? "; read too" : "") + "\n";
  }
  return text;
}

ExchangeResult WriteCamerasAs(std::string_view format_name,
                              const ExchangeSource& source,
                              const fs::path& out) {
  const CameraFormat* format = FindCameraFormat(format_name);
  if (format == nullptr) throw Error("no format is called " + Quote(format_name));
  ExchangeScene scene;
  scene.unit = source.unit;
  scene.georeference = source.georeference;
  if (!source.model_file.empty()) scene.model_file = fs::absolute(source.model_file);
  scene.registrations = source.registrations;
  const fs::path out_path = fs::absolute(out);
  if (format->is_on_globe) NeedGeoreference(scene, out_path);
  if (format->is_folder) RequireExportFolder(out_path, *format);
  const std::vector<std::string> names = NamesOf(source);
  CameraPreparation preparation(*format, source, out_path);
  for (size_t i = 0; i < source.cameras.size(); ++i) {
    scene.cameras.push_back(preparation.Prepare(source.cameras[i], names[i]));
  }
  if (format->format) {
    const std::vector<FileToWrite> files = format->format(scene, out_path);
    for (const FileToWrite& file : files) RequireNoInput(source, file.file);
    WriteFilesAtomically(files);
  } else {
    std::vector<NamedCamera> cameras;
    for (const ExchangeCamera& each : scene.cameras) {
      cameras.push_back({each.image_name, each.camera});
    }
    for (const char* name : {"cameras.txt", "images.txt"}) {
      RequireNoInput(source, out_path / name);
    }
    WriteColmapModel(out_path, cameras);
  }
  ExchangeResult result;
  result.warnings = source.warnings;
  if (!format->format) {
    std::vector<std::string> images;
    for (const ExchangeCamera& each : scene.cameras) images.push_back(each.image_name);
    for (std::string& warning : TellNamesWithBlanks(out, images)) {
      result.warnings.push_back(std::move(warning));
    }
  }
  result.summary = CountOf(scene.cameras.size(), "camera") + " in " + out.string();
  if (preparation.NumChanged() > 0) {
    result.summary += "; " + CountOf(static_cast<size_t>(preparation.NumChanged()), "picture") +
                      " resampled, since " + std::string(format->name) +
                      " cannot hold them as they are";
  }
  return result;
}

ExchangeResult WriteCamerasAsViews(const ExchangeSource& source,
                                   const fs::path& out,
                                   double lookat_distance) {
  const std::vector<std::string> names = NamesOf(source);
  std::vector<FileToWrite> files;
  for (size_t i = 0; i < source.cameras.size(); ++i) {
    const ViewTag tag = TagFromCamera(source.cameras[i].camera, lookat_distance);
    if (const auto fault = FindTagFault(tag)) {
      throw Error(source.cameras[i].name + ": " + fault->message);
    }
    files.push_back({out / (names[i] + ".view"),
                     FormatView(tag,
                                "File: " + names[i] + ".view\nFrom another program's camera of " +
                                    source.cameras[i].name + ".")});
  }
  WriteFilesAtomically(files);
  return {CountOf(files.size(), "view file") + " in " + out.string(), source.warnings};
}

}  // namespace groundglass
