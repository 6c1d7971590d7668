// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// What else a scene may have been meant to be.
#include "scene/advice/advice_readings.h"

#include "scene/advice/advice_judge.h"
#include "scene/advice/picture_fit.h"
#include "scene/frames.h"
#include "scene/shell_word.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace groundglass {
namespace {

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

}  // namespace

// The model's axes, other than as they were read.
std::vector<Reading> OtherAxes(const AdviceContext& context) {
  std::vector<Reading> readings;
  const MeshAxes axes = AxesOf(context.scene.model_file, context.options);
  const MeshAxes own = AxesOf(context.scene.model_file, {});
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
    if (context.options.mesh_axes && words.axes == own) {
      ModelOptions given;
      given.mesh_axes = context.options.mesh_axes;
      reading.option = "without" + AxesOptions(given);
      reading.remedy = "leave out" + AxesOptions(given);
    }
    if (words.axes != MeshAxes::kYUp) continue;
    // Its faces may run clockwise as well.
    Reading turned = reading;
    turned.model.flips_faces = !turned.model.flips_faces;
    turned.message += context.options.flip_faces ? "" : ", and its faces run clockwise";
    turned.option += context.options.flip_faces ? " without --flip-faces" : " --flip-faces";
    turned.remedy = "give " + turned.option;
    turned.num_changes = 2;
    readings.push_back(turned);
  }
  return readings;
}

// y up and z north, as some programs have it: no option reads that, since it is left-handed.
std::vector<Reading> LeftHandedAxes(const AdviceContext& context) {
  const MeshAxes axes = AxesOf(context.scene.model_file, context.options);
  Eigen::Matrix3d world_from_file;
  world_from_file << 1, 0, 0, 0, 0, 1, 0, 1, 0;
  std::vector<Reading> readings;
  for (const bool flips_faces : {true, false}) {
    Reading& reading = readings.emplace_back();
    reading.model.linear = world_from_file * WorldFromAxes(axes).inverse();
    reading.model.flips_faces = flips_faces;
    reading.message = "its y axis is up and its z axis counts north, which is left-handed";
    reading.remedy =
        "change the sign of every z, and give --up y (--up y by itself reads it mirrored); if its "
        "faces show their backs then, --flip-faces too";
    reading.num_changes = 2;
  }
  return readings;
}

// The options with which the model's axes were read, as they are typed: " --up y --flip-faces".
std::string AxesOptions(const ModelOptions& options) {
  std::string text;
  if (options.mesh_axes == MeshAxes::kWorld) text = " --frame world";
  if (options.mesh_axes == MeshAxes::kSite) text = " --frame site";
  if (options.mesh_axes == MeshAxes::kYUp) text = " --up y";
  if (options.mesh_axes == MeshAxes::kZUp) text = " --up z";
  return text + (options.flip_faces ? " --flip-faces" : "");
}

namespace {

// The command that brings the model's numbers to the tags' unit, as it can be typed. What it writes
// has the axes of its format, so that it is read without the options for them.
std::string ConvertRemedy(const AdviceContext& context,
                          const std::string& axes_options,
                          LengthUnit of_model,
                          LengthUnit of_tags) {
  const std::string tags_unit = UnitName(of_tags);
  const std::string output = ShellWord(context.scene.folder / ("model-in-" + tags_unit + ".osu"));
  return "bring them together: groundglass convert " + ShellWord(context.scene.model_file) + " " +
         output + axes_options + " --unit " + UnitName(of_model) + " --to-unit " + tags_unit +
         ", and from then on give --model " + output +
         (axes_options.empty() ? "" : " in place of" + axes_options);
}

}  // namespace

// The model's numbers in one unit, the tags' in another.
std::vector<Reading> OtherUnits(const AdviceContext& context, const std::string& axes_options) {
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
      reading.remedy = ConvertRemedy(context, axes_options, of_model, of_tags);
    }
  }
  return readings;
}

namespace {

// Where the model's y as well may count the other way, which options read.
Reading NorthInTags(const AdviceContext& context) {
  Reading reading;
  reading.message = "y counts north in the tags";
  reading.remedy = "in view files y counts south: change the signs of y and j in every tag";
  const MeshAxes axes = AxesOf(context.scene.model_file, context.options);
  if (axes != MeshAxes::kWorld && axes != MeshAxes::kSite) return reading;
  const bool is_world = axes == MeshAxes::kWorld;
  reading.message += is_world ? ", or south in the model" : ", or in the model";
  reading.remedy += std::string(", or, if it is the model whose y counts ") +
                    (is_world ? "south, give --frame site" : "north, give --frame world") +
                    (context.options.flip_faces ? ", and leave out --flip-faces" : " --flip-faces");
  return reading;
}

}  // namespace

// The tags' numbers, written in another order or with another sign.
std::vector<Reading> OtherTags(const AdviceContext& context) {
  using Order = Eigen::Vector3d (*)(const Eigen::Vector3d&);  // what was meant by a place
  std::vector<Reading> readings;
  const auto add = [&](Reading reading, Order in_site) {
    reading.retag = [in_site](ViewTag tag) {
      tag.position_in_site = in_site(tag.position_in_site);
      tag.lookat_in_site = in_site(tag.lookat_in_site);
      return tag;
    };
    readings.push_back(std::move(reading));
  };
  Reading exchanged;
  exchanged.message = "x and y are exchanged in the tags, or in the model";
  exchanged.remedy = "in view files x counts east and y south: exchange x with y, and i with j";
  add(exchanged, [](const auto& p) { return Eigen::Vector3d(p.y(), p.x(), p.z()); });
  add(NorthInTags(context), [](const auto& p) { return Eigen::Vector3d(p.x(), -p.y(), p.z()); });
  Reading surveyed;
  surveyed.message = "x counts north and y east in the tags, as surveyors write";
  surveyed.remedy =
      "in view files x counts east and y south: write y in place of x, and -x in place of y; the "
      "same for i and j";
  add(surveyed, [](const auto& p) { return Eigen::Vector3d(p.y(), -p.x(), p.z()); });
  Reading west;
  west.message = "x counts west in the tags, or in the model";
  west.remedy = "in view files x counts east: change the signs of x and i in every tag";
  add(west, [](const auto& p) { return Eigen::Vector3d(-p.x(), p.y(), p.z()); });
  // Heights below 0 by chance are of another zero.
  const auto are_all = [&](const auto& is_so) {
    return std::all_of(context.scene.photographs.begin(),
                       context.scene.photographs.end(),
                       [&](const auto& one) { return is_so(one.tag); });
  };
  const bool looks_down = are_all([](const ViewTag& tag) { return tag.lookat_in_site.z() < 0; });
  if (looks_down && are_all([](const ViewTag& tag) { return tag.position_in_site.z() < 0; })) {
    Reading down;
    down.message = "z counts downwards in the tags, or in the model";
    down.remedy = "in view files z counts up: change the signs of z and k in every tag";
    add(down, [](const auto& p) { return Eigen::Vector3d(p.x(), p.y(), -p.z()); });
  } else if (looks_down) {
    Reading down;
    down.message = "k counts downwards in the tags, and z upwards";
    down.remedy = "in view files both count up: change the sign of k in every tag";
    down.retag = [](ViewTag tag) {
      tag.lookat_in_site.z() *= -1;
      return tag;
    };
    readings.push_back(std::move(down));
  }
  Reading turned;
  turned.message = "the cameras' places and the points that they look at are exchanged";
  turned.remedy = "x y z is where the camera stood: exchange x with i, y with j, and z with k";
  turned.retag = [](ViewTag tag) {
    std::swap(tag.position_in_site, tag.lookat_in_site);
    return tag;
  };
  readings.push_back(std::move(turned));
  return readings;
}

std::vector<Reading> OtherAngles(const AdviceContext& context) {
  if (!context.scene.tags_have_angles) return {};
  using Change = Eigen::Vector2d (*)(const Eigen::Vector2d&);  // yaw, pitch in degrees
  std::vector<Reading> readings;
  const auto add = [&](const std::string& message, const std::string& remedy, Change change) {
    Reading& reading = readings.emplace_back();
    reading.message = message;
    reading.remedy = remedy;
    reading.retag = [change](ViewTag tag) {
      const Eigen::Vector3d axis = tag.lookat_in_site - tag.position_in_site;
      const double distance = axis.norm();
      if (!(distance > 0)) return tag;
      const Eigen::Vector2d meant =
          change({DegreesFromRadians(std::atan2(axis.x(), axis.y())),
                  DegreesFromRadians(std::asin(std::clamp(axis.z() / distance, -1.0, 1.0)))});
      const double yaw = RadiansFromDegrees(meant.x());
      const double pitch = RadiansFromDegrees(meant.y());
      tag.lookat_in_site =
          tag.position_in_site + distance * Eigen::Vector3d(std::sin(yaw) * std::cos(pitch),
                                                            std::cos(yaw) * std::cos(pitch),
                                                            std::sin(pitch));
      return tag;
    };
  };
  add("pitch counts downwards in the table",
      "it counts up from the horizon: change the sign of every pitch",
      [](const auto& a) { return Eigen::Vector2d(a.x(), -a.y()); });
  add("yaw is a bearing from north, clockwise, in the table",
      "it counts from south through east: write 180 - yaw in its place",
      [](const auto& a) { return Eigen::Vector2d(180 - a.x(), a.y()); });
  add("yaw counts the other way round in the table",
      "it counts from south through east: change the sign of every yaw",
      [](const auto& a) { return Eigen::Vector2d(-a.x(), a.y()); });
  add("pitch counts from the zenith in the table",
      "it counts up from the horizon: write 90 - pitch in its place",
      [](const auto& a) { return Eigen::Vector2d(a.x(), 90 - a.y()); });
  add("yaw and pitch are in radians in the table",
      "they are in degrees: multiply them by 57.2958",
      [](const auto& a) { return Eigen::Vector2d(a * 180 / M_PI); });
  add("yaw and pitch are in gon (400 to a circle) in the table",
      "they are in degrees: multiply them by 0.9",
      [](const auto& a) {
        // Tables count from 0 to 400.
        return Eigen::Vector2d(0.9 * (a.x() < 0 ? a.x() + 360 : a.x()), 0.9 * a.y());
      });
  return readings;
}

std::vector<Reading> LookatsAsDirections(const AdviceContext& context) {
  // Of the model's size: so near to the origin lie directions of any usual length.
  constexpr double kShort = 0.05;
  const double size = context.bounds.Diagonal();
  for (const Photograph& photograph : context.scene.photographs) {
    if (photograph.tag.lookat_in_site.norm() > kShort * size) return {};
  }
  Reading reading;
  reading.message = "i, j, k are a direction in every tag, and no point";
  reading.remedy =
      "they are a point that the camera looks at, in the model's unit: write x + 100 i in place of "
      "i, and likewise for j and k";
  reading.retag = [middle = SiteFromWorld(context.bounds.Center())](ViewTag tag) {
    const double distance = (middle - tag.position_in_site).norm();
    const Eigen::Vector3d direction = tag.lookat_in_site.normalized();
    tag.lookat_in_site = tag.position_in_site + distance * direction;
    return tag;
  };
  return {reading};
}

std::vector<Reading> HeightsDownwards(const AdviceContext& context) {
  if (context.bounds.max.z() > 0.1 * context.bounds.Diagonal()) return {};
  std::vector<Reading> readings;
  for (const bool flips_faces : {true, false}) {
    Reading& reading = readings.emplace_back();
    reading.model.linear = Eigen::Vector3d(1, flips_faces ? 1 : -1, -1).asDiagonal();
    reading.model.flips_faces = flips_faces;
    reading.message = flips_faces ? "its z counts downwards" : "it stands on its head";
    reading.remedy = flips_faces ? "change the sign of every z in the model (it must count up)"
                                 : "turn it over in the program that drew it";
  }
  return readings;
}

const Reading* FindClearlyBest(const std::vector<Reading>& readings,
                               const PolygonModel& model,
                               const PictureJudge& judge,
                               const std::vector<double>& fits_as_read,
                               double least_mean) {
  const Reading* best = nullptr;
  double best_mean = least_mean;
  for (const Reading& reading : readings) {
    const std::vector<double> fits =
        judge.Fit(ReadOtherwise(model, reading.model), reading.retag, kTagReach);
    const double mean = PictureJudge::Mean(fits);
    if (mean <= best_mean || !PictureJudge::IsClearlyBetter(fits, fits_as_read)) continue;
    best = &reading;
    best_mean = mean;
  }
  return best;
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
  // Where the cameras stand beside the building, only what they look at may count so.
  const double middle_height = camera_heights[camera_heights.size() / 2];
  if (middle_height > context.bounds.min.z() && middle_height < context.bounds.max.z()) {
    Reading& reading = readings.emplace_back();
    reading.retag = [by_lookat](ViewTag tag) {
      tag.lookat_in_site.z() -= by_lookat;
      return tag;
    };
    reading.message = "k lies about " +
                      FormatLength(std::abs(by_lookat), context.scene.model.unit) +
                      (by_lookat > 0 ? " too high" : " too low") +
                      " in all tags, so that it counts from another zero than z";
    reading.remedy = "count both from the model's: change k of every tag by about " +
                     FormatNumber(-std::round(by_lookat * 10) / 10);
  }
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

}  // namespace groundglass
