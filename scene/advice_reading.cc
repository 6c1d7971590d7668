// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// The whole scene read otherwise. A wrong axis, unit or datum moves every camera away from what it
// was said to look at; the reading under which nearly all of them look at the model again, at the
// distance of their look-at points, is the one that was meant.
#include "scene/advice_parts.h"
#include "scene/frames.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace groundglass {
namespace {

// A few dozen tags tell as much as all of them.
constexpr size_t kMostTags = 40;
// One tag may fit a wrong reading by chance.
constexpr size_t kFewestTags = 2;

struct Reading {
  OtherReading model;
  std::function<ViewTag(const ViewTag&)> retag;  // none: as they are
  std::string message;
  std::string remedy;
  std::string option;  // where one is all that it takes
  int num_changes = 1;
};

// How a reading suits the tags.
struct Suitability {
  double implausible_share = 0;
  double plausible_share = 0;
  double median_lookat_error = 0;
  double front_share = 0;

  double Score(int num_changes) const {
    return plausible_share + 0.5 * front_share - median_lookat_error - 0.03 * num_changes;
  }
};

Suitability Summarise(const std::vector<Standpoint>& standpoints) {
  Suitability summary;
  const double count = static_cast<double>(standpoints.size());
  std::vector<double> errors;
  double model_share = 0;
  double front_share = 0;
  for (const Standpoint& standpoint : standpoints) {
    summary.implausible_share += IsImplausible(standpoint) ? 1 / count : 0;
    summary.plausible_share += IsPlausible(standpoint) ? 1 / count : 0;
    errors.push_back(standpoint.lookat_error);
    model_share += standpoint.model_share;
    front_share += standpoint.model_share * standpoint.front_share;
  }
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  summary.median_lookat_error = errors[errors.size() / 2];
  summary.front_share = model_share > 0 ? front_share / model_share : 0;
  return summary;
}

std::vector<const Photograph*> SomePhotographs(const Scene& scene) {
  const size_t total = scene.photographs.size();
  const size_t count = std::min(total, kMostTags);
  std::vector<const Photograph*> some;
  for (size_t i = 0; i < count; ++i) some.push_back(&scene.photographs[i * total / count]);
  return some;
}

Suitability Try(const AdviceContext& context,
                const std::vector<const Photograph*>& photographs,
                const Reading& reading) {
  std::vector<Standpoint> standpoints;
  for (const Photograph* photograph : photographs) {
    const ViewTag tag = reading.retag ? reading.retag(photograph->tag) : photograph->tag;
    if (FindTagFault(tag)) continue;
    standpoints.push_back(FindStandpoint(context.bounds,
                                         context.visibility,
                                         context.scene.model,
                                         tag,
                                         photograph->size,
                                         reading.model));
  }
  return standpoints.empty() ? Suitability{1, 0, 1, 0} : Summarise(standpoints);
}

struct AxesWords {
  MeshAxes axes;
  const char* message;
  const char* option;
};
constexpr std::array<AxesWords, 3> kAxesWords = {{
    {MeshAxes::kWorld, "its y axis counts north and its z axis up", "--frame world --up z"},
    {MeshAxes::kSite, "its y axis counts south, so that it was read mirrored", "--frame site"},
    {MeshAxes::kYUp, "its y axis is up, so that it was read lying on its back", "--up y"},
}};

// The model's axes, other than as they were read.
std::vector<Reading> OtherAxes(const AdviceContext& context) {
  std::vector<Reading> readings;
  const MeshAxes axes = AxesOf(context.scene.model_file, context.options);
  const Eigen::Matrix3d world_from_read = WorldFromAxes(axes).inverse();
  for (const AxesWords& words : kAxesWords) {
    if (words.axes == axes) continue;
    Reading& reading = readings.emplace_back();
    reading.model.linear = WorldFromAxes(words.axes) * world_from_read;
    reading.model.flips_faces = reading.model.linear.determinant() < 0;
    reading.message = words.message;
    reading.option = words.option;
    if (axes == MeshAxes::kSite && words.axes == MeshAxes::kWorld) {
      reading.message = "its y axis counts north, so that it was read mirrored";
      reading.option = "--frame world";
    }
    reading.remedy = "give " + reading.option;
  }
  return readings;
}

// The model's numbers in one unit, the tags' in another.
std::vector<Reading> OtherUnits(const AdviceContext& context) {
  constexpr std::array<LengthUnit, 5> kUnits = {LengthUnit::kMillimetre,
                                                LengthUnit::kCentimetre,
                                                LengthUnit::kInch,
                                                LengthUnit::kFoot,
                                                LengthUnit::kMetre};
  std::vector<Reading> readings;
  for (const LengthUnit of_model : kUnits) {
    for (const LengthUnit of_tags : kUnits) {
      if (of_model == of_tags) continue;
      const double ratio = MetresPerUnit(of_model) / MetresPerUnit(of_tags);
      Reading& reading = readings.emplace_back();
      reading.model.linear *= ratio;
      const std::string model_unit = UnitName(of_model);
      const std::string tags_unit = UnitName(of_tags);
      const std::string times =
          FormatNumber(std::round(100 * std::max(ratio, 1 / ratio)) / 100) + " times as large as ";
      reading.message = (ratio < 1 ? "the model's numbers are " + times + "the tags'"
                                   : "the tags' numbers are " + times + "the model's") +
                        ": it is in " + model_unit + " and they in " + tags_unit + ", it seems";
      const std::string file = context.scene.model_file.filename().string();
      reading.remedy = "bring them together: groundglass convert " + file + " model-in-" +
                       tags_unit + ".osu --unit " + model_unit + " --to-unit " + tags_unit;
    }
  }
  return readings;
}

// The tags' numbers, written in another order or with another sign.
std::vector<Reading> OtherTags() {
  struct Order {
    const char* message;
    const char* remedy;
    Eigen::Vector3d (*site)(const Eigen::Vector3d&);
  };
  constexpr std::array<Order, 4> kOrders = {{
      {"x and y are exchanged in the tags, or in the model",
       "in view files x counts east and y south: exchange x with y, and i with j",
       [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); }},
      {"y counts north in the tags, or south in the model",
       "in view files y counts south: change the signs of y and j in every tag, or, if it is the "
       "model whose y counts south, give --frame site --flip-faces",
       [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); }},
      {"x counts north and y east in the tags, as surveyors write",
       "in view files x counts east and y south: write y in place of x, and -x in place of y; the "
       "same for i and j",
       [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.y(), -p.x(), p.z()); }},
      {"x counts west in the tags, or in the model",
       "in view files x counts east: change the signs of x and i in every tag",
       [](const Eigen::Vector3d& p) { return Eigen::Vector3d(-p.x(), p.y(), p.z()); }},
  }};
  std::vector<Reading> readings;
  for (const Order& order : kOrders) {
    Reading& reading = readings.emplace_back();
    reading.retag = [site = order.site](ViewTag tag) {
      tag.position_in_site = site(tag.position_in_site);
      tag.lookat_in_site = site(tag.lookat_in_site);
      return tag;
    };
    reading.message = order.message;
    reading.remedy = order.remedy;
  }
  return readings;
}

// All heights off by the same: the look-at points lie all above the model, or all below it.
std::vector<Reading> OtherDatums(const AdviceContext& context,
                                 const std::vector<const Photograph*>& photographs) {
  std::vector<double> camera_heights;
  std::vector<double> lookat_heights;
  for (const Photograph* photograph : photographs) {
    camera_heights.push_back(photograph->tag.position_in_site.z());
    lookat_heights.push_back(photograph->tag.lookat_in_site.z());
  }
  std::sort(camera_heights.begin(), camera_heights.end());
  std::sort(lookat_heights.begin(), lookat_heights.end());
  const double height = context.bounds.max.z() - context.bounds.min.z();
  const bool is_above = lookat_heights.front() > context.bounds.max.z() + 0.1 * height;
  const bool is_below = lookat_heights.back() < context.bounds.min.z() - 0.1 * height;
  if (!is_above && !is_below) return {};
  const double eye = 1.6 / MetresPerUnit(context.scene.model.unit);
  const double by_eye = camera_heights[camera_heights.size() / 2] - eye - context.bounds.min.z();
  const double by_lookat = lookat_heights[lookat_heights.size() / 2] - context.bounds.Center().z();
  std::vector<Reading> readings;
  for (const double datum : {by_eye, by_lookat}) {
    Reading& reading = readings.emplace_back();
    reading.model.offset.z() = datum;
    reading.message = "all heights in the tags lie about " +
                      FormatLength(std::abs(datum), context.scene.model.unit) +
                      (datum > 0 ? " above" : " below") +
                      " the model's, so that they count from another zero";
    reading.remedy = "count both from the same height: change z and k of every tag by about " +
                     FormatNumber(-std::round(datum * 10) / 10) + ", or move the model";
  }
  return readings;
}

Reading Combined(const Reading& axes, const Reading& unit) {
  Reading both = axes;
  both.model.linear = unit.model.linear * axes.model.linear;
  both.message = axes.message + ", and " + unit.message;
  both.remedy = axes.remedy + ", and " + unit.remedy;
  both.num_changes = 2;
  return both;
}

// A model that was mirrored but stands about the origin is still looked at, from its wrong sides:
// its faces' backs and the look-at points tell.
bool IsMirrored(const Suitability& as_read, const Suitability& other, const Reading& reading) {
  return reading.model.flips_faces && as_read.front_share < 0.35 && other.front_share > 0.65 &&
         as_read.median_lookat_error > 0.05 &&
         other.median_lookat_error < 0.4 * as_read.median_lookat_error;
}

// Axes that mirror the model, if the tags suit them as well: faces that show their backs may then
// come of either. Where one of the two suits far better, that is what is meant.
std::optional<Reading> MirroredReading(const AdviceContext& context) {
  if (context.scene.photographs.size() < kFewestTags) return std::nullopt;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  const Suitability as_read = Try(context, photographs, {});
  for (const Reading& reading : OtherAxes(context)) {
    if (!reading.model.flips_faces) continue;
    const Suitability suits = Try(context, photographs, reading);
    const bool is_possible = suits.plausible_share >= 0.7 && suits.median_lookat_error <= 0.12 &&
                             suits.front_share > 0.65;
    const bool is_worse = suits.median_lookat_error > 0.05 &&
                          as_read.median_lookat_error < 0.4 * suits.median_lookat_error;
    if (is_possible && !is_worse) return reading;
  }
  return std::nullopt;
}

void AdviseOnWhatIsUnknown(const AdviceContext& context, size_t num_implausible) {
  std::vector<double> distances;
  for (const Standpoint& standpoint : context.standpoints) distances.push_back(standpoint.distance);
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  const double distance = distances[distances.size() / 2];
  const double diagonal = context.bounds.Diagonal();
  if (distance > 30 * diagonal) {
    context.Add(Advice::Severity::kScene,
                context.scene.model_file.string(),
                "the cameras stand about " + FormatLength(distance, context.scene.model.unit) +
                    " from the model, which is " +
                    FormatLength(diagonal, context.scene.model.unit) + " from corner to corner",
                "give the tags and the model the same origin and the same unit");
    return;
  }
  context.Add(Advice::Severity::kScene,
              context.scene.folder.string(),
              std::to_string(num_implausible) + " of " +
                  std::to_string(context.standpoints.size()) +
                  " tags stand inside the model or under it, or do not show it",
              "tags and model need the same origin, axes (x east, y south in view files, z up) and "
              "unit; look at the overlays (groundglass check SCENE -o DIR)");
}

}  // namespace

Misreading AdviseOnReading(const AdviceContext& context) {
  if (context.scene.photographs.size() < kFewestTags) return Misreading::kNone;
  const std::vector<const Photograph*> photographs = SomePhotographs(context.scene);
  const Suitability as_read = Try(context, photographs, {});
  const bool is_suspicious = as_read.implausible_share >= 0.5 || as_read.plausible_share <= 0.4 ||
                             as_read.median_lookat_error > 0.2 || as_read.front_share < 0.35;
  if (!is_suspicious) return Misreading::kNone;

  const std::vector<Reading> axes = OtherAxes(context);
  const std::vector<Reading> units = OtherUnits(context);
  std::vector<Reading> readings = axes;
  readings.insert(readings.end(), units.begin(), units.end());
  for (const Reading& reading : OtherTags()) readings.push_back(reading);
  for (const Reading& reading : OtherDatums(context, photographs)) readings.push_back(reading);
  // Two changes at once would fit a handful of tags by chance.
  if (photographs.size() > 3) {
    for (const Reading& one : axes) {
      for (const Reading& other : units) readings.push_back(Combined(one, other));
    }
  }

  const Reading* best = nullptr;
  double best_score = 0;
  for (const Reading& reading : readings) {
    const Suitability suits = Try(context, photographs, reading);
    const bool is_better = suits.plausible_share >= as_read.plausible_share + 0.35 ||
                           IsMirrored(as_read, suits, reading);
    if (suits.plausible_share < 0.7 || suits.median_lookat_error > 0.12 || !is_better) continue;
    const double score = suits.Score(reading.num_changes);
    if (best && score <= best_score) continue;
    best = &reading;
    best_score = score;
  }
  if (best) {
    context.Add(Advice::Severity::kScene,
                context.scene.model_file.string(),
                best->message + ": only so do the cameras look at it",
                best->remedy);
    const double scale = std::cbrt(std::abs(best->model.linear.determinant()));
    return std::abs(scale - 1) > 1e-6 ? Misreading::kOfUnit : Misreading::kOther;
  }
  if (as_read.implausible_share < 0.6) return Misreading::kNone;
  AdviseOnWhatIsUnknown(
      context,
      static_cast<size_t>(
          std::count_if(context.standpoints.begin(), context.standpoints.end(), IsImplausible)));
  return Misreading::kOther;
}

bool AdviseOnBacks(const AdviceContext& context, bool with_pictures) {
  double model_share = 0;
  double back_share = 0;
  for (const Standpoint& standpoint : context.standpoints) {
    model_share += standpoint.model_share;
    back_share += standpoint.model_share * (1 - standpoint.front_share);
  }
  if (model_share == 0 || back_share < 0.5 * model_share) return false;
  const std::string shown = std::to_string(std::lround(100 * back_share / model_share)) +
                            " % of what the photographs show of the model are backs of faces, "
                            "which take no texture: ";
  const std::string clockwise = "their points run clockwise";
  const std::optional<Reading> mirrored = MirroredReading(context);
  std::optional<bool> is_mirrored;
  if (!mirrored) {
    is_mirrored = false;
  } else if (with_pictures) {
    is_mirrored = FindWhetherMirrored(context, mirrored->model);
  }
  std::string why;
  std::string remedy;
  if (!is_mirrored) {
    why = clockwise + ", or " + mirrored->message + "; the tags suit either";
    remedy = "look at the overlays (groundglass check SCENE -o DIR) with --flip-faces and with " +
             mirrored->option + ", and give the one with which they fit";
  } else if (*is_mirrored) {
    why = mirrored->message + ", as the pictures' edges tell";
    remedy = mirrored->remedy;
  } else {
    why = clockwise;
    remedy = "give --flip-faces, or turn them where the model was made";
  }
  context.Add(Advice::Severity::kScene, context.scene.model_file.string(), shown + why, remedy);
  return true;
}

}  // namespace groundglass
