// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/register_arguments.h"

#include "cli/warnings_last.h"
#include "register/control_points.h"
#include "register/registration_output.h"
#include "register/select_photographs.h"
#include "scene/advice.h"
#include "scene/frames.h"
#include "scene/image_io.h"
#include "scene/registration_io.h"
#include "viewer/overlay.h"

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <sstream>

namespace groundglass {
namespace {

std::string FormatSigma(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

std::string JoinWithCommas(const std::vector<std::string>& names) {
  std::string joined;
  for (const std::string& name : names) joined += (joined.empty() ? "" : ",") + name;
  return joined;
}

}  // namespace

void AddRegisterArguments(CLI::App* command, RegisterArguments& arguments) {
  PriorOptions& prior = arguments.options.prior;
  command->add_option("scene", arguments.scene_folder, "scene folder: model, views/, images/")
      ->required();
  command->add_option("-o,--out", arguments.out_folder, "where to write")->required();
  command->add_option("--model", arguments.model_file, "the model, in place of the scene's own");
  command->add_option("--lens", arguments.lens_file, "lens file, as `calibrate board` writes it");
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
  const std::string by_hand = "Help by hand, photographs by name, with commas between";
  command->add_option("--only", arguments.only, "the photographs to register; others are left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(by_hand);
  command
      ->add_option("--points",
                   arguments.points_file,
                   "points file: photograph x_px y_px x y z sigma_px, three or more for each")
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
  command->add_option("--sigma-position", prior.position_m, "across, metres")
      ->capture_default_str()
      ->group(group);
  command->add_option("--sigma-height", prior.height_m, "metres")
      ->capture_default_str()
      ->group(group);
  command->add_option("--sigma-lookat", prior.lookat_m, "metres")
      ->capture_default_str()
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
  command->add_option("--sigma-shift", prior.shift, "fraction of the frame's width")
      ->capture_default_str()
      ->group(group);
  command->add_option("--sigma-k1", prior.k1, "radial distortion")
      ->capture_default_str()
      ->group(group);
  AddModelOptions(command, arguments.model_arguments);
}

Scene ReadSceneForCommand(const RegisterArguments& arguments, const CommonOptions& common) {
  SceneOptions options;
  options.model_file = arguments.model_file;
  options.model = arguments.model_arguments.Options();
  Scene scene = ReadScene(arguments.scene_folder, options);
  for (const Advice& advice : FindOddities(scene, options.model)) {
    scene.warnings.push_back(FormatAdvice(advice));
  }
  RequirePhotographs(scene, arguments.only, "option --only");
  RequirePhotographs(scene, arguments.options.overrule.accept, "option --accept");
  RequirePhotographs(scene, arguments.options.overrule.reject, "option --reject");
  if (arguments.points_file) {
    std::vector<std::string> names;
    for (const ControlPoint& point : ReadControlPoints(*arguments.points_file)) {
      names.push_back(point.photograph);
    }
    RequirePhotographs(scene, names, arguments.points_file->string());
  }
  KeepPhotographs(arguments.only, scene);
  return scene;
}

Manifest DescribeInputs(const std::string& command,
                        const Scene& scene,
                        const RegisterArguments& arguments,
                        const CommonOptions& common) {
  Manifest manifest;
  manifest.version = GROUNDGLASS_VERSION;
  manifest.command = command;
  manifest.seed = common.seed;
  const auto add = [&](const std::filesystem::path& file) {
    const std::filesystem::path relative = file.lexically_relative(scene.folder);
    const bool is_inside = !relative.empty() && *relative.begin() != "..";
    manifest.sha256_of_inputs[(is_inside ? relative : file.filename()).generic_string()] =
        HashFile(file);
  };
  add(scene.model_file);
  if (arguments.lens_file) add(*arguments.lens_file);
  if (arguments.points_file) add(*arguments.points_file);
  for (const Photograph& photograph : scene.photographs) {
    add(photograph.image_file);
    if (!photograph.view_file.empty()) add(photograph.view_file);
    if (photograph.mask_file) add(*photograph.mask_file);
    if (photograph.faces_file) add(*photograph.faces_file);
  }
  for (const char* table : {"tags.csv", "pairs.csv"}) {
    if (std::filesystem::exists(scene.folder / table)) add(scene.folder / table);
  }
  const PriorOptions& prior = arguments.options.prior;
  manifest.options["unit"] = UnitName(scene.model.unit);
  manifest.options["sigma-position"] = FormatSigma(prior.position_m);
  manifest.options["sigma-height"] = FormatSigma(prior.height_m);
  manifest.options["sigma-lookat"] = FormatSigma(prior.lookat_m);
  manifest.options["sigma-roll"] = FormatSigma(prior.roll_deg);
  manifest.options["sigma-v"] = FormatSigma(prior.view_angle_share);
  manifest.options["sigma-a"] = FormatSigma(prior.aspect_share);
  manifest.options["sigma-shift"] = FormatSigma(prior.shift);
  manifest.options["sigma-k1"] = FormatSigma(prior.k1);
  manifest.options["digital"] = prior.digital ? "yes" : "no";
  manifest.options["lock"] = JoinWithCommas(prior.lock);
  manifest.options["free"] = JoinWithCommas(prior.free);
  manifest.options["independent"] = arguments.options.independent ? "yes" : "no";
  manifest.options["only"] = JoinWithCommas(arguments.only);
  manifest.options["accept"] = JoinWithCommas(arguments.options.overrule.accept);
  manifest.options["reject"] = JoinWithCommas(arguments.options.overrule.reject);
  return manifest;
}

RegisteredScene RegisterAndWrite(const Scene& scene,
                                 const RegisterArguments& arguments,
                                 const CommonOptions& common) {
  std::optional<Lens> lens;
  if (arguments.lens_file) lens = ReadLens(*arguments.lens_file);
  RegisterOptions options = arguments.options;
  if (arguments.points_file) options.control_points = ReadControlPoints(*arguments.points_file);
  RegisteredScene registered =
      RegisterScene(scene, lens, options, MakeProgress(common, "registering"));
  const std::vector<Registration>& registrations = registered.registrations;

  const Progress progress = MakeProgress(common, "drawing overlays");
  const std::vector<ModelEdge> edges = FindModelEdges(scene.model);
  const Visibility visibility(scene.model);
  const int total = static_cast<int>(registrations.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(0, total, [&](int i) {
    const Registration& registration = registrations[i];
    const Camera measured = registration.MeasuredCamera();
    const Camera corrected = registration.CorrectedCamera();
    const bool is_rejected = registration.verdict == Verdict::kRejected;
    WriteSrgb8(arguments.out_folder / "overlays" / (registration.name + ".jpg"),
               DrawOverlay(ReadSrgb8(scene.photographs[i].image_file),
                           scene.model,
                           edges,
                           visibility,
                           measured,
                           is_rejected ? nullptr : &corrected));
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(done, total, registration.name);
  });
  // Last, because its being there says that the stage is complete.
  WriteRegistrationOutput(scene, registered, arguments.out_folder);
  return registered;
}

void PrintRegistrations(const std::vector<Registration>& registrations) {
  std::printf("%-12s %-9s %9s %8s %8s  %s\n",
              "photograph",
              "verdict",
              "moved px",
              "rms px",
              "score",
              "why not accepted");
  for (const Registration& registration : registrations) {
    std::string reasons;
    for (const std::string& reason : registration.reasons) {
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    std::printf("%-12s %-9s %9.1f %8.2f %8.0f  %s\n",
                registration.name.c_str(),
                std::string(VerdictName(registration.verdict)).c_str(),
                registration.moved_px,
                registration.rms_px,
                registration.score_nats,
                reasons.c_str());
  }
}

void PrintModelErrors(const std::vector<ModelError>& model_errors, LengthUnit unit) {
  if (model_errors.empty()) return;
  const std::string unit_name = UnitName(unit);
  std::printf(
      "\nThe photographs see these lines of the model elsewhere (x east, y south, z up):\n");
  for (const ModelError& error : model_errors) {
    const Eigen::Vector3d offset_in_site = SiteFromWorld(error.offset_in_world);
    std::printf("%-40s off by %+.2f %+.2f %+.2f %s, +-%.2f, in %d photographs\n",
                error.name.c_str(),
                offset_in_site.x(),
                offset_in_site.y(),
                offset_in_site.z(),
                unit_name.c_str(),
                error.sigma,
                error.num_photographs);
  }
}

void PrintVerdictCounts(const std::vector<Registration>& registrations, size_t num_warnings) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(registrations.begin(), registrations.end(), [&](const auto& one) {
      return one.verdict == verdict;
    });
  };
  std::printf("\n%zu photographs: %td accepted, %td in review, %td rejected; %s\n",
              registrations.size(),
              count(Verdict::kAccepted),
              count(Verdict::kReview),
              count(Verdict::kRejected),
              CountWarnings(num_warnings).c_str());
}

void PrintRegistrationsJson(const RegisteredScene& registered,
                            const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(
      FormatRegistrations(registered.registrations, registered.model_errors));
  json["warnings"] = warnings;
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
