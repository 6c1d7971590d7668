// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/gltf_textures.h"

#include "scene/formats/gltf_accessor.h"
#include "scene/formats/image_io.h"
#include "scene/formats/material_library.h"
#include "scene/text.h"

namespace groundglass {
namespace {

Image8 DecodeGltfImage(const tinygltf::Image& image, const std::filesystem::path& file) {
  const std::vector<unsigned char>& bytes = image.image;
  if (bytes.empty()) {
    if (image.uri.starts_with("data:")) {
      throw Error("a picture of the kind " +
                  Quote(image.uri.substr(0, image.uri.find_first_of(";,"))) +
                  " in the file's text is not read; export it as .glb");
    }
    const auto found = FindNamedFile(file.parent_path(), image.uri);
    if (found) return ReadSrgb8(*found);
    throw Error("the picture " + Quote(image.uri.empty() ? image.name : image.uri) +
                " is not there");
  }
  try {
    return DecodeSrgb8(bytes, "");  // told by its content
  } catch (const Error& error) {
    throw Error("a picture cannot be read: " + std::string(error.what()));
  }
}

}  // namespace

int FindTextureImage(const tinygltf::Texture& texture, std::set<std::string>& unread) {
  if (texture.extensions.empty()) return texture.source;
  // The plain source is for programs that do not read WebP.
  const auto webp = texture.extensions.find("EXT_texture_webp");
  if (webp != texture.extensions.end() && webp->second.IsObject() && webp->second.Has("source") &&
      webp->second.Get("source").IsInt()) {
    const int source = webp->second.Get("source").GetNumberAsInt();
    if (texture.source < 0 && source >= 0) return source;
  }
  if (texture.source < 0) unread.insert(texture.extensions.begin()->first);
  return texture.source;
}

void DecodeGltfPages(const tinygltf::Model& gltf,
                     const std::filesystem::path& file,
                     TexturedModel& textured,
                     std::vector<std::string>& warnings) {
  constexpr int kNotTried = -1;
  constexpr int kNone = -2;
  std::vector<int> page_of_image(gltf.images.size(), kNotTried);
  std::vector<int> num_grey(gltf.images.size(), 0);
  std::vector<std::string> faults(gltf.images.size());
  for (FaceTexture& face : textured.faces) {
    if (face.page < 0) continue;
    const auto image = static_cast<size_t>(face.page);
    GltfItem(gltf.images, face.page, "image", file);
    int& page = page_of_image[image];
    if (page == kNotTried) {
      try {
        Image8 srgb8 = DecodeGltfImage(gltf.images[image], file);
        page = static_cast<int>(textured.pages.size());
        textured.pages.emplace_back().srgb8 = std::move(srgb8);
      } catch (const Error& error) {
        page = kNone;
        faults[image] = error.what();
      }
    }
    if (page == kNone) {
      face = FaceTexture();
      ++num_grey[image];
      continue;
    }
    face.page = page;
    const Image8& picture = textured.pages[static_cast<size_t>(page)].srgb8;
    for (Eigen::Vector2d& corner : face.corners_texel) {
      corner = {corner.x() * picture.width, corner.y() * picture.height};
    }
  }
  for (size_t image = 0; image < faults.size(); ++image) {
    if (faults[image].empty()) continue;
    warnings.push_back(Error(file,
                             faults[image] + "; " +
                                 (num_grey[image] == 1 ? std::string("its face is grey")
                                                       : "its " + std::to_string(num_grey[image]) +
                                                             " faces are grey"))
                           .what());
  }
}

}  // namespace groundglass
