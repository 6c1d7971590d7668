// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// What a file is, by its content: names are wrong too often (a PNG called .jpg, no extension).
// Only some camera raw files, which have no mark of their own, go by the name; Targa has none
// either, and is what fits nothing else and has a Targa's header.
struct ImageKind {
  std::string reader;       // OpenImageIO's name of the format; empty: no image that is read here
  std::string description;  // for a person: "a PDF", "text", "an empty file"
  std::string remedy;       // what to do, if it is no image

  bool IsImage() const { return !reader.empty(); }
};

ImageKind FindImageKind(const std::filesystem::path& file);
// The same of bytes in memory; the name is what it would be called.
ImageKind FindImageKind(std::span<const uint8_t> bytes, const std::filesystem::path& name);

// True for the extensions of images that are read here, in upper or lower case: ".jpg", ".NEF".
bool IsImageExtension(std::string_view extension);

// A file's name without folder and without an image's extension: "images/s5.JPG" and "s5" are s5,
// "house.v2" stays as it is.
std::string ImageStem(const std::filesystem::path& file);

// The plain files of a folder that are images by content or by name, in natural order; hidden ones
// are left out.
std::vector<std::filesystem::path> ListImageFiles(const std::filesystem::path& folder);

// For messages: what may stand where an image is expected.
constexpr const char* kImageNames = ".jpg, .png, .tif, .heic or another image";

}  // namespace groundglass
