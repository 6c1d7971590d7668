// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "drawing/write_drawing.h"

#include "drawing/drawing_layers.h"
#include "drawing/drawing_lines.h"
#include "drawing/drawing_painter.h"
#include "drawing/drawing_pdf.h"
#include "drawing/layer_pictures.h"
#include "drawing/tiff_writer.h"
#include "scene/check_option.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/frames.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <string>

namespace groundglass {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Pixels of a layer in the PDF for each of the picture's, along a side.
constexpr int kLayerStep = 8;

fs::path WithSuffix(const fs::path& stem, const std::string& suffix) {
  fs::path file = stem;
  file += suffix;
  return file;
}

Json InSite(const Eigen::Vector3d& in_world) {
  const Eigen::Vector3d in_site = SiteFromWorld(in_world);
  // A negative zero is no news.
  return {in_site.x() + 0.0, in_site.y() + 0.0, in_site.z() + 0.0};
}

Json PanelJson(const DrawingPanel& panel, double metres) {
  return {{"origin", InSite(panel.plane.origin_in_world)},
          {"u", InSite(panel.plane.right_in_world)},
          {"v", InSite(panel.plane.up_in_world)},
          {"normal", InSite(panel.plane.TowardsViewer())},
          {"facing_deg", FacingDeg(panel.plane)},
          {"u_from_m", panel.u_start * metres},
          {"u_to_m", panel.u_end * metres},
          {"u_on_sheet_m", panel.u_on_sheet * metres}};
}

Json SpreadJson(const std::optional<Spread>& spread, double factor = 1) {
  if (!spread) return nullptr;
  return {{"low", factor * spread->low},
          {"middle", factor * spread->middle},
          {"high", factor * spread->high}};
}

Json DrawingJson(const Drawing& drawing,
                 const PolygonModel& model,
                 const WrittenDrawing& written,
                 const DrawingSources& sources,
                 const WriteDrawingOptions& options) {
  const double metres = MetresPerUnit(model.unit);
  const DrawingAccuracy& accuracy = written.accuracy;
  Json json;
  json["drawing"] = drawing.name;
  json["scale"] = options.scale;
  json["dpi"] = options.dpi;
  json["pixel_m"] = options.PixelInMetres();
  json["width_px"] = written.grid.width_px;
  json["height_px"] = written.grid.height_px;
  json["u_left_m"] = drawing.UStart() * metres;
  json["v_top_m"] = drawing.v_end * metres;
  json["unit"] = UnitName(model.unit);
  json["panels"] = Json::array();
  for (const DrawingPanel& panel : drawing.panels)
    json["panels"].push_back(PanelJson(panel, metres));
  if (model.georeference) {
    json["georeference"] = {{"latitude_deg", model.georeference->latitude_deg},
                            {"longitude_deg", model.georeference->longitude_deg},
                            {"height_m", model.georeference->height_m},
                            {"north_deg", model.georeference->north_deg}};
  }
  json["accuracy"] = {{"promise_m", accuracy.promise_m},
                      {"photograph_pixel_m", SpreadJson(accuracy.photograph_pixel_m)},
                      {"camera_sigma_m", SpreadJson(accuracy.camera_sigma_m)},
                      {"model_sigma_m", accuracy.model_sigma_m},
                      {"model_sigma_is_assumed", accuracy.is_model_sigma_assumed},
                      {"off_plane_share", accuracy.off_plane_share},
                      {"most_before_m", accuracy.most_before_m},
                      {"most_behind_m", accuracy.most_behind_m},
                      {"slant", SpreadJson(accuracy.slant)},
                      {"untextured_share", accuracy.untextured_share},
                      {"sentences", DescribeAccuracy(accuracy)},
                      {"warnings", AccuracyWarnings(accuracy)}};
  json["photographs"] = sources.photographs;
  json["files"] = Json::array();
  for (const fs::path& file : written.files) json["files"].push_back(file.filename().string());
  return json;
}

// One drawing being written.
class DrawingFiles {
 public:
  DrawingFiles(const fs::path& stem,
               Renderer& renderer,
               const TexturedModel& textured,
               const Drawing& drawing,
               const DrawingSources& sources,
               const WriteDrawingOptions& options)
      : stem_(stem),
        renderer_(renderer),
        textured_(textured),
        drawing_(drawing),
        sources_(sources),
        options_(options),
        metres_(MetresPerUnit(textured.model.unit)),
        painter_(renderer, drawing, MakeGrid(drawing, options.PixelInMetres() / metres_)) {}

  WrittenDrawing Write() {
    written_.grid = painter_.Grid();
    written_.accuracy = AssessDrawing(
        renderer_, textured_, drawing_, sources_, options_.scale, painter_.Grid().pixel_size);
    if (Wants("tif")) WritePicture();
    if (Wants("layers")) WriteLayers();
    if (Wants("pdf") || Wants("svg") || Wants("dxf")) WriteLines();
    const fs::path json = WithSuffix(stem_, ".json");
    WriteFileAtomically(json,
                        DrawingJson(drawing_, textured_.model, written_, sources_, options_)
                                .dump(1, ' ', false, Json::error_handler_t::replace) +
                            "\n");
    written_.files.push_back(json);
    return written_;
  }

 private:
  bool Wants(const std::string& kind) const {
    return std::find(options_.kinds.begin(), options_.kinds.end(), kind) != options_.kinds.end();
  }

  TiffSheet Sheet(const std::string& what) const {
    const DrawingGrid& grid = painter_.Grid();
    TiffSheet sheet;
    sheet.width_px = grid.width_px;
    sheet.height_px = grid.height_px;
    sheet.dpi = options_.dpi;
    sheet.pixel_size_m = grid.pixel_size * metres_;
    sheet.u_m = drawing_.UStart() * metres_;
    sheet.v_m = drawing_.v_end * metres_;
    sheet.plane_name = "Groundglass elevation: " + drawing_.name;
    Json json = {{"drawing", drawing_.name}, {"shows", what}, {"scale", options_.scale}};
    for (const DrawingPanel& panel : drawing_.panels) {
      json["panels"].push_back(PanelJson(panel, metres_));
    }
    sheet.description = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    return sheet;
  }

  template <typename Rows>
  void WriteRaster(const std::string& suffix, const std::string& what, const Rows& rows) {
    const fs::path file = WithSuffix(stem_, suffix);
    const TiffSheet sheet = Sheet(what);
    WriteTiff(file, sheet, std::function(rows));
    written_.files.push_back(file);
    fs::path world_file = file;
    world_file.replace_extension(".tfw");
    WriteFileAtomically(world_file, FormatWorldFile(sheet));
    written_.files.push_back(world_file);
  }

  void WritePicture() {
    WriteRaster(".tif", "colours", [&](int row, int num) { return painter_.Colours(row, num); });
  }

  void WriteLayers() {
    const DrawingLayers layers(painter_, textured_, sources_);
    WriteRaster("-photographs.tif", "photographs by number", [&](int row, int num) {
      return layers.Photographs(row, num);
    });
    WriteRaster("-sigma.tif", "one standard deviation, m", [&](int row, int num) {
      return layers.Sigmas(row, num);
    });
    WriteRaster("-height.tif", "height above the plane, m", [&](int row, int num) {
      return layers.Heights(row, num);
    });
  }

  std::vector<LayerPicture> PictureLayers() {
    if (!Wants("layers")) return {};
    const DrawingPainter coarse(
        renderer_, drawing_, MakeGrid(drawing_, kLayerStep * painter_.Grid().pixel_size));
    const DrawingLayers layers(coarse, textured_, sources_);
    return {PicturePhotographs(layers, coarse.Grid(), sources_),
            PictureSigmas(layers, coarse.Grid())};
  }

  std::string Title() const { return options_.title.empty() ? drawing_.name : options_.title; }

  void WriteLines() {
    const std::vector<DrawnLine> lines =
        FindDrawnLines(textured_.model, drawing_, painter_.Grid().pixel_size);
    const TiffSheet picture = Sheet("lines");
    LineSheet sheet;
    sheet.title = Title();
    sheet.scale = options_.scale;
    sheet.width_m = picture.width_px * picture.pixel_size_m;
    sheet.height_m = picture.height_px * picture.pixel_size_m;
    sheet.u_start_m = picture.u_m;
    sheet.v_start_m = picture.v_m - sheet.height_m;
    const auto write = [&](const std::string& suffix, const std::string& text) {
      WriteFileAtomically(WithSuffix(stem_, suffix), text);
      written_.files.push_back(WithSuffix(stem_, suffix));
    };
    if (Wants("svg")) write(".svg", FormatSvg(lines, sheet));
    if (Wants("dxf")) write(".dxf", FormatDxf(lines, sheet));
    if (!Wants("pdf")) return;
    PdfSheetOptions pdf;
    pdf.scale = options_.scale;
    pdf.dpi = options_.dpi;
    pdf.has_title_block = options_.has_title_block;
    pdf.title = Title();
    pdf.note = options_.note;
    pdf.sentences = DescribeAccuracy(written_.accuracy);
    for (const std::string& warning : AccuracyWarnings(written_.accuracy)) {
      pdf.sentences.push_back("Warning: " + warning + ".");
    }
    const fs::path file = WithSuffix(stem_, ".pdf");
    const std::set<std::string> unshown =
        WriteDrawingPdf(file, drawing_, painter_, lines, PictureLayers(), metres_, pdf);
    if (!unshown.empty()) {
      std::string list;
      for (const std::string& character : unshown) list += (list.empty() ? "" : " ") + character;
      written_.warnings.push_back(
          "the PDF's font cannot show " + list +
          ", and has ? in its place; write --title and --note with other characters");
    }
    written_.files.push_back(file);
  }

  fs::path stem_;
  Renderer& renderer_;
  const TexturedModel& textured_;
  const Drawing& drawing_;
  const DrawingSources& sources_;
  const WriteDrawingOptions& options_;
  double metres_;
  DrawingPainter painter_;
  WrittenDrawing written_;
};

}  // namespace

void WriteDrawingOptions::Check() const {
  CheckAbove(scale, 0, "drawing options: scale");
  CheckFromTo(dpi, 10, 2400, "drawing options: dpi");
  for (const std::string& kind : kinds) {
    const auto known = {"tif", "pdf", "svg", "dxf", "layers"};
    if (std::find(known.begin(), known.end(), kind) == known.end()) {
      throw Error("drawing options: kinds may be tif, pdf, svg, dxf and layers, not " + kind);
    }
  }
}

WrittenDrawing WriteDrawing(const fs::path& stem,
                            Renderer& renderer,
                            const TexturedModel& textured,
                            const Drawing& drawing,
                            const DrawingSources& sources,
                            const WriteDrawingOptions& options) {
  options.Check();
  return DrawingFiles(stem, renderer, textured, drawing, sources, options).Write();
}

}  // namespace groundglass
