// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/model_kind.h"

#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/shell_word.h"
#include "scene/text.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr size_t kModelHeadSize = 1 << 18;
constexpr const char* kExportModel =
    "export it as .glb, .gltf, .obj, .ply or .stl from the program that made it";
constexpr const char* kMesh =
    "make a mesh of it, with CloudCompare or MeshLab, and export that as .ply";
constexpr const char* kFromCityJson =
    "export it as CityGML (.gml), with citygml-tools, or as .obj, with cjio";
constexpr const char* kExportCameras =
    "export the cameras as COLMAP's (text), nerfstudio's transforms.json or Metashape's .xml";
constexpr const char* kGiveFolder = "give the folder that it stands in";
constexpr const char* kCloud = "a cloud of points (LAS)";
constexpr const char* kUsd = "a USD file";

// Formats that say at their beginning what they are.
struct ModelMark {
  std::string_view text;
  const char* ending;
  const char* description;
  const char* remedy;
};
constexpr ModelMark kModelMarks[] = {
    {"glTF"sv, ".glb", "a GLB", ""},
    {"Kaydara FBX Binary"sv, "", "an FBX file", kExportModel},
    {"; FBX "sv, "", "an FBX file", kExportModel},
    {"BLENDER"sv, "", "a Blender file", kExportModel},
    {"AC10"sv, "", "a DWG drawing", kExportModel},
    {"AutoCAD Binary DXF"sv, "", "a DXF drawing", kExportModel},
    {"3D Geometry File Format "sv, "", "a Rhino file", kExportModel},
    {"\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0U\0p\0"sv, "", "a SketchUp file", kExportModel},
    {"LASF"sv, "", kCloud, kMesh},
    {"#VRML"sv, "", "a VRML file", kExportModel},
    {"PXR-USDC"sv, "", kUsd, kExportModel},
    {"#usda "sv, "", kUsd, kExportModel},
};

uint32_t NumberAt(std::string_view bytes, size_t at) {
  uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i) {
    number |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return number;
}

// Those that only their length tells: a header, the number of triangles, fifty bytes for each.
bool IsBinaryStl(std::string_view head, uintmax_t size) {
  constexpr size_t kStart = 84;
  constexpr uintmax_t kTriangle = 50;
  if (head.size() < kStart) return false;
  const uint32_t count = NumberAt(head, 80);
  return count > 0 && size == kStart + kTriangle * count;
}

bool Is3ds(std::string_view head, uintmax_t size) {
  return head.starts_with("MM"sv) && head.size() > 6 && NumberAt(head, 2) == size;
}

bool IsOpeningTag(std::string_view text, std::string_view name) {
  for (size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    if (at > 0 && (text[at - 1] == '<' || text[at - 1] == ':')) return true;
  }
  return false;
}

// Cameras, which people take for what is read: other programs', and single files of a folder that
// is.
ModelKind KindOfCameras(std::string_view text) {
  if (text.starts_with("# Bundle file")) return {"", "a file of Bundler's cameras", kExportCameras};
  if (text.starts_with("NVM_V3")) return {"", "a file of VisualSFM's cameras", kExportCameras};
  if (text.starts_with("#name,x,y,alt")) {
    return {"", "a table of RealityCapture's cameras", kExportCameras};
  }
  const std::string_view start = text.substr(0, 512);
  for (const char* mark : {"IMAGE_ID", "CAMERA_ID", "POINT3D_ID"}) {
    if (start.starts_with("#") && start.find(mark) != std::string_view::npos) {
      return {"", "one file of a COLMAP model", kGiveFolder};
    }
  }
  return {};
}

ModelKind KindOfXml(std::string_view text) {
  if (IsOpeningTag(text, "CityModel")) return {".gml", "CityGML", ""};
  if (IsOpeningTag(text, "BlocksExchange")) {
    return {"", "a file of BlocksExchange's cameras", kExportCameras};
  }
  if (IsOpeningTag(text, "COLLADA")) return {"", "a COLLADA file", kExportModel};
  if (IsOpeningTag(text, "X3D")) return {"", "an X3D file", kExportModel};
  if (IsOpeningTag(text, "kml")) return {"", "a KML file", kExportModel};
  return {};
}

ModelKind KindOfJson(std::string_view text) {
  const auto has = [&](std::string_view word) { return text.find(word) != std::string::npos; };
  // First, since names in it may be any of the others' words.
  if (has("\"asset\"") && (has("\"meshes\"") || has("\"nodes\""))) return {".gltf", "a glTF", ""};
  if (has("\"CityJSON\"")) return {"", "CityJSON", kFromCityJson};
  if (has("\"sfm_data_version\"")) return {"", "a file of OpenMVG's cameras", kExportCameras};
  if (has("\"shots\"") && has("\"cameras\""))
    return {"", "a file of OpenSfM's cameras", kExportCameras};
  if (has("\"FeatureCollection\"")) return {"", "GeoJSON", kExportModel};
  return {};
}

// The first lines that have words, parted at blanks; `comment`: what begins one.
std::vector<TextLine> FirstLines(std::string_view text, char comment) {
  constexpr size_t kMost = 400;
  std::vector<TextLine> lines;
  for (TextLine& line : SplitLines(text, comment)) {
    if (line.tokens.empty()) continue;
    lines.push_back(std::move(line));
    if (lines.size() == kMost) break;
  }
  return lines;
}

bool AreNumbers(const TextLine& line, size_t first, size_t count) {
  if (line.tokens.size() < first + count) return false;
  return std::all_of(line.tokens.begin() + static_cast<std::ptrdiff_t>(first),
                     line.tokens.begin() + static_cast<std::ptrdiff_t>(first + count),
                     [](const TextToken& token) { return ParseNumber(token.text).has_value(); });
}

// A point among the first lines.
bool IsObj(std::string_view text) {
  const std::vector<TextLine> lines = FirstLines(text, '#');
  return std::any_of(lines.begin(), lines.end(), [](const TextLine& line) {
    return line.tokens[0].text == "v" && AreNumbers(line, 1, 3);
  });
}

// Two counts alone on a line, then a point.
bool IsOsu(std::string_view text) {
  const std::vector<TextLine> lines = FirstLines(text, '%');
  if (lines.size() < 2 || lines[0].tokens.size() != 2 || lines[1].tokens.size() != 3) return false;
  const auto num_points = ParseInteger(lines[0].tokens[0].text);
  const auto num_faces = ParseInteger(lines[0].tokens[1].text);
  return num_points && *num_points >= 3 && num_faces && *num_faces >= 1 &&
         AreNumbers(lines[1], 0, 3);
}

ModelKind KindOfText(std::string_view text) {
  text = TrimBlanks(text);
  if (text.empty()) return {};
  if (text.front() == '<') return KindOfXml(text);
  if (text.front() == '{' || text.front() == '[') return KindOfJson(text);
  if (ModelKind cameras = KindOfCameras(text); !cameras.description.empty()) return cameras;
  if (text.starts_with("ISO-10303-21")) {
    const bool is_ifc = text.find("'IFC") != std::string_view::npos;
    return {"", is_ifc ? "an IFC file" : "a STEP file", kExportModel};
  }
  const std::string lower = LowerCase(text.substr(0, 2048));
  if (lower.starts_with("solid") && lower.find("facet") != std::string::npos) {
    return {".stl", "an STL", ""};
  }
  const std::vector<TextLine> lines = FirstLines(text.substr(0, 2048), '#');
  if (!lines.empty() && lines[0].tokens.size() == 1) {
    const std::string_view word = lines[0].tokens[0].text;
    if (word == "OFF" || word == "COFF") return {"", "an OFF file", kExportModel};
    if (word == "0" && lines.size() > 1 && lines[1].tokens[0].text == "SECTION") {
      return {"", "a DXF drawing", kExportModel};
    }
  }
  if (IsObj(text)) return {".obj", "an OBJ", ""};
  if (IsOsu(text)) return {".osu", "an OSU model", ""};
  return {};
}

// What was downloaded or packed under a model's name.
ModelKind KindOfWrapping(const fs::path& file) {
  const ImageKind kind = FindImageKind(file);
  if (kind.description.ends_with("archive")) return {"", kind.description, kind.remedy};
  if (kind.description == "a web page") {
    return {"", kind.description, "save the file that the page offers"};
  }
  return {};
}

bool IsReadHere(const std::string& ending) {
  for (const char* known : {".osu", ".obj", ".ply", ".stl", ".glb", ".gltf"}) {
    if (ending == known) return true;
  }
  return false;
}

bool IsGltfEnding(const std::string& ending) { return ending == ".glb" || ending == ".gltf"; }

}  // namespace

ModelKind FindModelKind(const fs::path& file) {
  std::error_code error;
  const uintmax_t size = fs::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) return {};
  if (LowerCase(file.extension().string()) == ".view") return {"", "a view file", kGiveFolder};
  std::string bytes(kModelHeadSize, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  if (IsBinaryStl(bytes, size)) return {".stl", "an STL", ""};
  if (Is3ds(bytes, size)) return {"", "a 3DS file", kExportModel};
  for (const ModelMark& mark : kModelMarks) {
    if (bytes.starts_with(mark.text)) return {mark.ending, mark.description, mark.remedy};
  }
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string_view word = text.substr(0, 3);
  if (LowerCase(word) == "ply" && text.size() > 3 && (text[3] == '\n' || text[3] == '\r')) {
    return {".ply", "a PLY", ""};
  }
  if (IsUtf16(bytes)) return KindOfText(Utf8FromBytes(bytes).text);
  if (text.find('\0') != std::string_view::npos) return {};
  return KindOfText(text);
}

void CheckModelKind(const fs::path& file) {
  const std::string own = LowerCase(file.extension().string());
  const ModelKind kind = FindModelKind(file);
  if (kind.description.empty()) {
    // Archives of a model's own kind (.usdz, .3mf) are not to be unpacked.
    const ModelKind wrapping = IsReadHere(own) ? KindOfWrapping(file) : ModelKind();
    if (wrapping.description.empty()) return;
    throw Error(file, "this is " + wrapping.description + " and no model; " + wrapping.remedy);
  }
  if (kind.ending.empty()) {
    throw Error(
        file,
        "this is " + kind.description +
            (kind.remedy == kGiveFolder ? ", which is not read alone; " : ", which is not read; ") +
            kind.remedy);
  }
  const bool is_rightly_named =
      kind.ending == own || (IsGltfEnding(kind.ending) && IsGltfEnding(own));
  fs::path renamed = file;
  if (!is_rightly_named) renamed.replace_extension(kind.ending);
  std::string message = "this is " + kind.description;
  if (!is_rightly_named) {
    message +=
        " by its content, which its name does not say; rename it to " + renamed.filename().string();
  }
  if (kind.ending == ".gml") {
    fs::path made = file;
    made.replace_extension(".osu");
    message += std::string(is_rightly_named ? "; " : ", then ") +
               "make a model of it: groundglass convert " + ShellWord(renamed) + " " +
               ShellWord(made);
  } else if (is_rightly_named) {
    return;
  }
  throw Error(file, message);
}

}  // namespace groundglass
