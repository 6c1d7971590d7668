// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "gui/app.h"
#include "scene/error.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace groundglass {
namespace {

namespace fs = std::filesystem;

// With two digits that tell something: "0.0123 ft".
std::string LengthText(double length, const std::string& unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.2g %s", length, unit.c_str());
  return text;
}

}  // namespace

std::map<std::string, Eigen::Matrix3d> FindWrittenSpread(const Scene& scene) {
  std::map<std::string, Eigen::Matrix3d> spread;
  OpenedFolder written;
  written.scene = scene;
  for (const SurveyPhotograph& photograph : SurveyOf(written).photographs) {
    spread[photograph.name] = photograph.covariance.topLeftCorner<3, 3>();
  }
  return spread;
}

std::optional<Eigen::Matrix3d> App::FoundSpread(int photograph) const {
  const auto run = document_.registrations.find(session_.photographs()[photograph].name);
  if (session_.IsAsFound(photograph) && run != document_.registrations.end()) {
    return Eigen::Matrix3d(run->second.covariance.topLeftCorner<3, 3>());
  }
  if (session_.UndoDepth(photograph) == 0) return std::nullopt;
  if (const auto& accepted = session_.work(photograph).accepted) {
    const double across = accepted->sigmas.position.value_or(0);
    const double height = accepted->sigmas.height.value_or(0);
    return Eigen::Matrix3d(Eigen::Vector3d(across, across, height).cwiseAbs2().asDiagonal());
  }
  const auto& solution = session_.Solution(photograph);
  if (!solution) return std::nullopt;
  return Eigen::Matrix3d(solution->covariance.topLeftCorner<3, 3>());
}

void App::ShowFaces(DrawMode mode) {
  draw_mode_ = mode;
  map_ = LookMap::kNone;
  shown_map_.reset();
}

void App::ShowMap(LookMap map) {
  if (map == LookMap::kTiles1988 && !tiles_) {
    OpenTiles();
    if (!tiles_) return;
  }
  map_ = map;
  shown_map_.reset();
  UpdateMap();
  if (!shown_map_ && map != LookMap::kTiles1988) message_ = "asking the photographs ...";
}

// Takes the map once it is made.
void App::UpdateMap() {
  if (map_ == LookMap::kNone || map_ == LookMap::kTiles1988 || shown_map_) return;
  try {
    shown_map_ = maps_.Find(map_);
    if (!shown_map_) return;
    message_.clear();
  } catch (const std::exception& error) {
    message_ = error.what();
    map_ = LookMap::kNone;
  }
  needs_frame_ = true;
}

void App::OpenTiles() {
  const fs::path folder = options_.folder / "tiles";
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".tiles") files.push_back(entry.path());
  }
  if (files.empty()) {
    message_ = document_.opened.is_output
                   ? folder.string() +
                         " holds no .tiles; `run` or `invrender` with --tiles makes "
                         "the database of 1988"
                   : "tiles of 1988 are in an output folder, made with --tiles";
    return;
  }
  std::sort(files.begin(), files.end());
  try {
    std::vector<MappedTiles> tiles;
    for (const fs::path& file : files) tiles.emplace_back(file);
    tiles_ = std::make_shared<const std::vector<MappedTiles>>(std::move(tiles));
  } catch (const Error& error) {
    message_ = error.what();
  }
}

std::string App::DescribeMapAt(const FacePick& pick) const {
  const std::vector<FaceCells>* cells = maps_.Cells();
  if (cells == nullptr) return "";
  const MapCell& cell = (*cells)[pick.face].AtPoint(pick.point_in_world);
  if (!cell.finest) return "no photograph shows it here";
  const std::string unit = UnitName(survey_.model.unit);
  return "here: shown by " + std::to_string(cell.num_photographs) + ", finest by " +
         survey_.photographs[*cell.finest].name + ", whose pixel is " +
         LengthText(cell.pixel_size, unit) + "; \u00B1 " + LengthText(cell.sigma, unit);
}

bool App::ColourFaces(Action action) {
  switch (action) {
    case Action::kWire:
      ShowFaces(DrawMode::kWireframe);
      return true;
    case Action::kShaded:
      ShowFaces(DrawMode::kShaded);
      return true;
    case Action::kTextured:
      ShowFaces(DrawMode::kTextured);
      return true;
    case Action::kNumbers:
      ShowFaces(DrawMode::kLabels);
      return true;
    case Action::kCoverage:
      ShowMap(LookMap::kCoverage);
      return true;
    case Action::kProvenance:
      ShowMap(LookMap::kProvenance);
      return true;
    case Action::kTexelSize:
      ShowMap(LookMap::kTexelSize);
      return true;
    case Action::kUncertainty:
      ShowMap(LookMap::kUncertainty);
      return true;
    case Action::kTiles1988:
      ShowMap(LookMap::kTiles1988);
      return true;
    default:
      return false;
  }
}

// Keys of Look, pressed inside a photograph: the model that is faded into it is coloured by them,
// too; others are told.
void App::DoBehindPhotograph(const KeyPress& press) {
  constexpr std::array<BindingPlace, 1> kThere = {BindingPlace::kLook};
  const Binding* binding = FindBinding(press, kThere);
  if (binding == nullptr) return;
  if (!ColourFaces(binding->action)) {
    message_ = std::string(binding->keys) + " is for the model alone: Esc leaves the photograph";
  } else if (model_share_ == 0 && !wipes_) {
    message_ = "the model is behind the photograph: . fades it in";
  }
}

}  // namespace groundglass
