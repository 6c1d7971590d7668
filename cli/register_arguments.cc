// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/register_arguments.h"

#include "cli/printed_zero.h"
#include "cli/warnings_last.h"
#include "register/register.h"
#include "scene/advice/advice.h"
#include "scene/building_bounds.h"
#include "scene/error.h"
#include "scene/formats/lens.h"
#include "scene/formats/pose_check.h"
#include "scene/formats/registration_io.h"
#include "scene/formats/select_photographs.h"
#include "scene/formats/text_encoding.h"
#include "scene/frames.h"
#include "scene/length_unit.h"
#include "scene/model_sigma.h"
#include "scene/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace groundglass {
void AddRegisterArguments(CLI::App* command, RegisterArguments& arguments) {
  PriorOptions& prior = arguments.options.prior;
  command->add_option("scene", arguments.scene_folder, "scene folder: model, views/, images/")
      ->required();
  command->add_option("-o,--out", arguments.out_folder, "where to write")->required();
  command
      ->add_option("--views",
                   arguments.views_folder,
                   "a COLMAP model (text, binary, sparse/0) or a folder of .view files in place "
                   "of the scene's own tags; say with --sigma-... how good they are")
      ->type_name("FOLDER");
  command->add_option("--model", arguments.model_file, "the model, in place of the scene's own")
      ->type_name("FILE");
  command->add_option("--lens", arguments.lens_file, "lens file, as `calibrate board` writes it")
      ->type_name("FILE");
  command->add_flag("--digital",
                    prior.digital,
                    "no slide mount and no scan: the lens is the same in every photograph");
  command
      ->add_option("--lock",
                   prior.lock,
                   "parameters to hold at the tag's values: x y z yaw pitch roll v a shift k1")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--free",
                   prior.free,
                   "parameters to look for whatever the tag or the lens file says: names as above")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--independent",
                    arguments.options.independent,
                    "each photograph by itself; else the accepted ones are refined together");
  command
      ->add_option("--ties",
                   arguments.ties,
                   "what photographs share, to refine them together: patches of faces, points "
                   "that the program COLMAP matches, both, or none")
      ->check(CLI::IsMember({"none", "patches", "colmap", "both"}))
      ->capture_default_str();
  const std::string by_hand = "Help by hand, photographs by name, with commas between";
  command->add_option("--only", arguments.only, "the photographs to register; others are left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(by_hand);
  command
      ->add_option("--points",
                   arguments.points_file,
                   "points file: photograph x_px y_px x y z sigma_px, three or more for each")
      ->type_name("FILE")
      ->group(by_hand);
  command
      ->add_option("--accept",
                   arguments.options.overrule.accept,
                   "accept what was found for these, whatever the verdict")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(by_hand);
  command
      ->add_option("--reject",
                   arguments.options.overrule.reject,
                   "keep these as they were measured and out of the texture")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(by_hand);
  const std::string group = "Standard deviations where the tag does not say";
  command
      ->add_option(
          "--sigma-position",
          prior.position_m,
          "across, metres; not given: 0.076 (less at a maquette), or 0.5 % of the distance, "
          "the larger")
      ->group(group);
  command->add_option("--sigma-height", prior.height_m, "metres; not given: 0.03 or 0.2 %")
      ->group(group);
  command->add_option("--sigma-lookat", prior.lookat_m, "metres; not given: 0.122 or 1 %")
      ->group(group);
  command->add_option("--sigma-roll", prior.roll_deg, "degrees")
      ->capture_default_str()
      ->group(group);
  command->add_option("--sigma-v", prior.view_angle_share, "view angle, as a share of it")
      ->capture_default_str()
      ->group(group);
  command->add_option("--sigma-a", prior.aspect_share, "aspect, as a share of it")
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--sigma-shift",
                   prior.shift,
                   "fraction of the frame's width; 0.015 if not given, 0.005 if --digital")
      ->group(group);
  command->add_option("--sigma-k1", prior.k1, "radial distortion")
      ->capture_default_str()
      ->group(group);
  AddModelOptions(command, arguments.model_arguments);
}

void AddKeepOption(CLI::App* command, RegisterArguments& arguments) {
  command
      ->add_option(
          "--keep",
          arguments.options.keep_folder,
          "also write there what the stages of registration hand to one another: samples, "
          "solutions, matches, a picture for each photograph; what refining them together takes "
          "and gives")
      ->type_name("DIR");
}

RegisterOptions ReadRegisterOptions(const RegisterArguments& arguments) {
  RegisterOptions options = arguments.options;
  if (arguments.points_file) options.control_points = ReadControlPoints(*arguments.points_file);
  options.use_ties = arguments.ties != "none";
  options.ties.use_patches = arguments.ties == "patches" || arguments.ties == "both";
  options.use_colmap = arguments.ties == "colmap" || arguments.ties == "both";
  return options;
}

OptionTexts ReadRegisterTexts(const RegisterArguments& arguments,
                              const std::vector<const CLI::Option*>& options) {
  OptionTexts texts = ReadOptionTexts(options);
  const RegisterOptions set = ReadRegisterOptions(arguments);
  if (!set.use_colmap) return texts;
  // Once it has been installed, what was found without it is made anew.
  try {
    texts.values["colmap version"] = FindColmapVersion(set.colmap);
  } catch (const Error&) {
    texts.values["colmap version"] = "missing";
  }
  return texts;
}

std::optional<Lens> ReadLensArgument(const RegisterArguments& arguments) {
  if (!arguments.lens_file) return std::nullopt;
  return ReadLens(*arguments.lens_file);
}

namespace {

// A lens of upright pictures for pictures that lie would reject every one of them.
void RequireSuitableLens(const std::filesystem::path& file, const Scene& scene) {
  constexpr double kMostRatio = 1.3;
  const Lens lens = ReadLens(file);
  for (const Photograph& photograph : scene.photographs) {
    const double ratio = lens.aspect * photograph.size.height / photograph.size.width;
    if (ratio < kMostRatio && ratio > 1 / kMostRatio) return;
  }
  if (scene.photographs.empty()) return;
  const ImageSize& size = scene.photographs.front().size;
  throw Error(file,
              "a " + FormatNumber(lens.aspect) + " suits no picture here (" +
                  scene.photographs.front().name + " is " + std::to_string(size.width) + " x " +
                  std::to_string(size.height) +
                  " pixels); it is of another camera, or of one that was held the other way");
}

// A standard deviation of several times the building's size holds nothing; most often it is meant
// in another unit.
std::vector<std::string> DescribeWideSigmas(const PriorOptions& prior, const PolygonModel& model) {
  constexpr double kSeveralTimes = 3;
  const double size_m = ComputeBuildingBounds(model).Diagonal() * MetresPerUnit(model.unit);
  std::vector<std::string> warnings;
  const auto look_at = [&](const std::optional<double>& sigma_m, const std::string& option) {
    if (!sigma_m || *sigma_m < kSeveralTimes * size_m) return;
    warnings.push_back(fmt::format(
        "{} {}: so many metres are several times the whole building ({:.0f} m across), as if the "
        "tags told nothing; it is in metres, whatever the model's unit",
        option,
        FormatNumber(*sigma_m),
        size_m));
  };
  look_at(prior.position_m, "--sigma-position");
  look_at(prior.height_m, "--sigma-height");
  look_at(prior.lookat_m, "--sigma-lookat");
  return warnings;
}

}  // namespace

Scene ReadSceneForCommand(const RegisterArguments& arguments,
                          const CommonOptions& common,
                          const std::vector<std::string>& not_needed) {
  SceneOptions options;
  options.model_file = arguments.model_file;
  options.model = arguments.model_arguments.Options();
  options.views = arguments.views_folder;
  options.only = arguments.only;
  options.exclude = not_needed;
  Scene scene = ReadScene(arguments.scene_folder, options);
  if (!common.quiet) {
    for (const std::string& note : scene.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  }
  if (!arguments.model_file) {
    const auto others = DescribeOtherModels(scene.folder, scene.model_file);
    if (others) scene.warnings.push_back(*others);
  }
  // Cameras from elsewhere have no tags to be odd.
  for (const Advice& advice : arguments.views_folder ? FindModelOddities(scene, options.model)
                                                     : FindOddities(scene, options.model)) {
    scene.warnings.push_back(FormatAdvice(advice));
    // Nothing will fit before it is mended, and the work is long: whoever sees it can stop.
    if (advice.severity == Advice::Severity::kScene && !common.dry_run) {
      PrintWarnings({scene.warnings.back()});
    }
  }
  for (const std::string& warning : DescribeWideSigmas(arguments.options.prior, scene.model)) {
    scene.warnings.push_back(warning);
  }
  RequireSoundPoses(scene);
  RequirePhotographs(scene, arguments.options.overrule.accept, "option --accept");
  RequirePhotographs(scene, arguments.options.overrule.reject, "option --reject");
  // Faults here are told before anything that is there already is given up.
  if (arguments.lens_file) RequireSuitableLens(*arguments.lens_file, scene);
  if (arguments.points_file) {
    std::vector<std::string> names;
    const std::vector<ControlPoint> points = ReadControlPoints(*arguments.points_file);
    for (const ControlPoint& point : points) names.push_back(point.photograph);
    RequirePhotographs(scene, names, arguments.points_file->string());
    CheckControlPoints(*arguments.points_file, points, scene);
    for (const std::string& warning : DescribeThinControlPoints(*arguments.points_file, points)) {
      scene.warnings.push_back(warning);
    }
  }
  return scene;
}

void PrintRegistrations(const std::vector<Registration>& registrations) {
  const auto number = [](const std::optional<double>& value, const char* format) {
    char text[32] = "-";
    if (value) std::snprintf(text, sizeof text, format, *value);
    return std::string(text);
  };
  int width = 12;
  for (const Registration& registration : registrations) {
    width = std::max(width, DisplayWidth(registration.name));
  }
  const auto print = [](const auto&... columns) {
    std::printf("%s %-10s %9s %8s %9s %8s %8s  %s\n", columns...);
  };
  print(PaddedTo(width, "photograph").c_str(),
        "verdict",
        "moved px",
        "rms px",
        "robust px",
        "score",
        "margin",
        "why not accepted");
  for (const Registration& registration : registrations) {
    std::string reasons;
    for (const std::string& reason : registration.reasons) {
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    const bool is_readable = registration.verdict != Verdict::kUnreadable;
    const auto if_readable = [&](double value) {
      return is_readable ? std::optional(value) : std::nullopt;
    };
    print(PaddedTo(width, registration.name).c_str(),
          std::string(VerdictName(registration.verdict)).c_str(),
          number(if_readable(registration.moved_px), "%.1f").c_str(),
          number(registration.rms_px, "%.2f").c_str(),
          number(registration.robust_sigma_px, "%.2f").c_str(),
          number(if_readable(registration.score_nats), "%.0f").c_str(),
          number(registration.margin_nats, "%.0f").c_str(),
          reasons.c_str());
  }
}

void PrintModelErrors(const std::vector<ModelError>& model_errors, const PolygonModel& model) {
  if (model_errors.empty()) return;
  const int decimals = LengthDecimals(model);
  const auto in_site = [&](const Eigen::Vector3d& in_world, const char* sign) {
    const Eigen::Vector3d place = SiteFromWorld(in_world);
    std::string text;
    for (const double value : place) {
      const double shown = ZeroIfRounded(value, decimals);
      text += (text.empty() ? "" : " ") + (*sign ? fmt::format("{:+.{}f}", shown, decimals)
                                                 : fmt::format("{:.{}f}", shown, decimals));
    }
    return text;
  };
  std::printf(
      "\nThe photographs see these lines of the model elsewhere (x east, y south, z up):\n");
  for (size_t i = 0; i < model_errors.size();) {
    const ModelError& error = model_errors[i];
    std::printf("%-40s off by %s %s, +-%.*f\n",
                error.name.c_str(),
                in_site(error.offset_in_world, "+").c_str(),
                UnitName(model.unit).c_str(),
                decimals,
                error.sigma);
    std::printf("    %.*f long, from %s to %s; in %s\n",
                decimals,
                (error.end_in_world - error.start_in_world).norm(),
                in_site(error.start_in_world, "").c_str(),
                in_site(error.end_in_world, "").c_str(),
                fmt::format("{}", fmt::join(error.photographs, " ")).c_str());
    const size_t first_with_it = ++i;
    while (i < model_errors.size() && model_errors[i].with_the_one_before) ++i;
    if (i > first_with_it) {
      std::printf("    and as much, with it: %s%s\n",
                  model_errors[first_with_it].name.c_str(),
                  i - first_with_it > 1 ? fmt::format(" and {} more (registration.json has them)",
                                                      i - first_with_it - 1)
                                              .c_str()
                                        : "");
    }
  }
}

void PrintWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "groundglass: warning: %s\n", warning.c_str());
  }
}

void PrintVerdictCounts(const std::vector<Registration>& registrations, size_t num_warnings) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(registrations.begin(), registrations.end(), [&](const auto& one) {
      return one.verdict == verdict;
    });
  };
  const auto num_unreadable = count(Verdict::kUnreadable);
  const std::string unreadable =
      num_unreadable > 0 ? ", " + std::to_string(num_unreadable) + " unreadable" : "";
  std::printf("\n%zu photographs: %td accepted, %td in review, %td rejected%s; %s\n",
              registrations.size(),
              count(Verdict::kAccepted),
              count(Verdict::kReview),
              count(Verdict::kRejected),
              unreadable.c_str(),
              CountWarnings(num_warnings).c_str());
}

void PrintRegistrationsJson(const RegisteredScene& registered,
                            const std::vector<std::string>& warnings,
                            const std::vector<std::string>& failures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(FormatRegistrations(
      registered.registrations, registered.model_errors, registered.warnings, registered.ties));
  json["warnings"] = warnings;
  if (!failures.empty()) json["failures"] = failures;
  std::printf("%s\n",
              json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

int ExitStatusOf(const std::vector<Registration>& registrations) {
  for (const Registration& registration : registrations) {
    if (registration.verdict != Verdict::kAccepted) return kExitNeedsReview;
  }
  return kExitDone;
}

}  // namespace groundglass
