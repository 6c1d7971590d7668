// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/elevation_arguments.h"
#include "cli/json_output.h"
#include "invrender/selection.h"
#include "scene/error.h"
#include "scene/frames.h"
#include "scene/text.h"
#include "viewer/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> SplitWords(const std::string& text) {
  std::vector<std::string> words;
  size_t start = 0;
  while (start <= text.size()) {
    const size_t comma = std::min(text.find(',', start), text.size());
    words.emplace_back(TrimBlanks(text.substr(start, comma - start)));
    start = comma + 1;
  }
  return words;
}

// "east", "east wall", "East elevation": the side that faces there.
std::optional<Drawing> FindSideByName(const std::vector<Drawing>& sides, const std::string& text) {
  std::string word = LowerCase(text);
  for (const std::string_view end : {" wall", " elevation", " side", " facade", " front"}) {
    if (word.ends_with(end)) word.resize(word.size() - end.size());
  }
  for (const Drawing& side : sides) {
    if (side.name == word) return side;
  }
  return std::nullopt;
}

std::string SideNames(const std::vector<Drawing>& sides) {
  std::string names;
  for (const Drawing& side : sides) names += (names.empty() ? "" : ", ") + side.name;
  return names;
}

std::vector<Drawing> MakeElevations(const ElevationArguments& arguments,
                                    const PolygonModel& model,
                                    const DrawingOptions& options) {
  if (arguments.elevation == "all") return MakeAllElevations(model, options);
  std::vector<int> faces;
  try {
    faces = FindFaces(model, SplitWords(arguments.elevation));
  } catch (const Error& error) {
    const std::vector<Drawing> sides = MakeAllElevations(model, options);
    if (const auto side = FindSideByName(sides, arguments.elevation)) return {*side};
    throw Error("--elevation: " + std::string(error.what()) +
                "; the model's sides are: " + SideNames(sides));
  }
  return {MakeElevation(model, faces, arguments.elevation, options)};
}

Drawing MakeCut(const std::string& text, const PolygonModel& model, const DrawingOptions& options) {
  if (text.starts_with("z=")) {
    const auto height = ParseNumber(text.substr(2));
    if (height && std::isfinite(*height)) return MakePlan(model, *height, options);
  }
  std::vector<double> numbers;
  for (const std::string& word : SplitWords(text)) {
    const auto number = ParseNumber(word);
    if (number && std::isfinite(*number)) numbers.push_back(*number);
  }
  if (numbers.size() != 4) {
    throw Error(
        "--section: " + Quote(text) +
        " is neither x,y,x,y (site, from the left to the right as it is seen) nor z=height");
  }
  const Eigen::Vector3d left = WorldFromSite({numbers[0], numbers[1], 0});
  const Eigen::Vector3d right = WorldFromSite({numbers[2], numbers[3], 0});
  return MakeSection(model, left.head<2>(), right.head<2>(), options);
}

std::vector<Drawing> MakeDrawings(const ElevationArguments& arguments, const PolygonModel& model) {
  DrawingOptions options = arguments.drawing;
  options.margin = arguments.margin_mm / 1000 * arguments.write.scale / MetresPerUnit(model.unit);
  if (!arguments.section.empty()) return {MakeCut(arguments.section, model, options)};
  if (!arguments.developed.empty()) {
    // Face by face, since their order is that of the street.
    std::vector<int> faces;
    for (const std::string& word : arguments.developed) {
      const std::vector<int> named = FindFaces(model, {word});
      faces.insert(faces.end(), named.begin(), named.end());
    }
    return {MakeDevelopedFacade(model, faces, "developed facade", options)};
  }
  return MakeElevations(arguments, model, options);
}

// "out/east.tif": the stem, and what the ending asks for.
struct OutputName {
  fs::path stem;
  std::string kind;
};
OutputName NameOfOutput(const fs::path& out) {
  std::string kind = LowerCase(out.extension().string());
  if (kind == ".tiff") kind = ".tif";
  if (kind != ".tif" && kind != ".pdf" && kind != ".svg" && kind != ".dxf") {
    throw Error(out, "a drawing to scale is written as .tif, .pdf, .svg or .dxf");
  }
  OutputName name = {out, kind.substr(1)};
  name.stem.replace_extension();
  return name;
}

fs::path StemOf(const OutputName& name, const Drawing& drawing, bool is_one_of_many) {
  if (!is_one_of_many) return name.stem;
  std::string file = name.stem.filename().string() + "-" + drawing.name;
  std::replace(file.begin(), file.end(), ' ', '-');
  return name.stem.parent_path() / file;
}

std::vector<std::string> WarningsOf(const WrittenDrawing& written) {
  std::vector<std::string> warnings = AccuracyWarnings(written.accuracy);
  warnings.insert(warnings.end(), written.warnings.begin(), written.warnings.end());
  return warnings;
}

nlohmann::ordered_json ToJson(const Drawing& drawing, const WrittenDrawing& written) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const fs::path& file : written.files) files.push_back(file.string());
  return {{"drawing", drawing.name},
          {"width_px", written.grid.width_px},
          {"height_px", written.grid.height_px},
          {"pixel_m", written.accuracy.pixel_m},
          {"sentences", DescribeAccuracy(written.accuracy)},
          {"warnings", WarningsOf(written)},
          {"files", files}};
}

void Print(const Drawing& drawing, const WrittenDrawing& written) {
  std::printf("%s: %d x %d px\n",
              written.files.front().c_str(),
              written.grid.width_px,
              written.grid.height_px);
  for (const std::string& sentence : DescribeAccuracy(written.accuracy)) {
    std::printf("  %s\n", sentence.c_str());
  }
  for (const std::string& warning : WarningsOf(written)) {
    std::fprintf(stderr, "groundglass: warning: %s: %s\n", drawing.name.c_str(), warning.c_str());
  }
}

// Where a section shows no cut, most likely the wrong numbers were typed.
std::optional<std::string> SectionWarning(const PolygonModel& model, const Drawing& drawing) {
  if (!drawing.is_section || CutsModel(model, drawing)) return std::nullopt;
  const Box bounds = ComputeBounds(model);
  const auto from_to = [](double a, double b) {
    return FormatNumber(std::round(10 * std::min(a, b)) / 10 + 0.0) + " to " +
           FormatNumber(std::round(10 * std::max(a, b)) / 10 + 0.0);
  };
  // y is south in `site`.
  return drawing.name + ": its plane does not meet the model, which reaches from x " +
         from_to(bounds.min.x(), bounds.max.x()) + ", y " +
         from_to(-bounds.min.y(), -bounds.max.y()) + ", z " +
         from_to(bounds.min.z(), bounds.max.z()) + "; what is behind it is drawn, and nothing cut";
}

// How large a drawing would be, for --dry-run.
nlohmann::ordered_json PlannedJson(const Drawing& drawing, const DrawingGrid& grid) {
  return {{"drawing", drawing.name}, {"width_px", grid.width_px}, {"height_px", grid.height_px}};
}

}  // namespace

int RenderElevations(const ElevationArguments& arguments,
                     const CommonOptions& common,
                     const TexturedModel& textured,
                     const fs::path& folder,
                     const fs::path& out,
                     const std::vector<std::string>& warnings) {
  const OutputName name = NameOfOutput(out);
  WriteDrawingOptions options = arguments.write;
  options.kinds = arguments.also;
  options.kinds.push_back(name.kind);
  const bool with_layers =
      std::find(options.kinds.begin(), options.kinds.end(), "layers") != options.kinds.end();
  if (with_layers && folder.empty()) {
    throw Error(out, "layers are made from an output folder, and not from a model alone");
  }
  const std::vector<Drawing> drawings = MakeDrawings(arguments, textured.model);
  DrawingSources sources;
  if (!folder.empty()) sources = ReadDrawingSources(folder, textured, with_layers);
  Renderer renderer(textured);
  std::vector<std::string> all_warnings = warnings;
  for (const Drawing& drawing : drawings) {
    const auto warning = SectionWarning(textured.model, drawing);
    if (warning) all_warnings.push_back(*warning);
  }
  all_warnings.insert(all_warnings.end(), renderer.Warnings().begin(), renderer.Warnings().end());
  for (const std::string& warning : all_warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Drawing& drawing : drawings) {
    const fs::path stem = StemOf(name, drawing, arguments.elevation == "all");
    if (common.dry_run) {
      const DrawingGrid grid =
          MakeGrid(drawing, options.PixelInMetres() / MetresPerUnit(textured.model.unit));
      list.push_back(PlannedJson(drawing, grid));
      if (!common.json) {
        std::printf("would write %s: %d x %d px\n", stem.c_str(), grid.width_px, grid.height_px);
      }
      continue;
    }
    const WrittenDrawing written =
        WriteDrawing(stem, renderer, textured, drawing, sources, options);
    list.push_back(ToJson(drawing, written));
    if (!common.json) Print(drawing, written);
  }
  if (common.json) {
    PrintJson({{"written", !common.dry_run}, {"drawings", list}, {"warnings", all_warnings}});
  }
  return kExitDone;
}

}  // namespace groundglass
