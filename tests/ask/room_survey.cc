// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/ask/room_survey.h"

namespace groundglass {
namespace {

ViewTag TagAt(const Eigen::Vector3d& position_in_world, const Eigen::Vector3d& lookat_in_world) {
  ViewTag tag;
  tag.position_in_site = SiteFromWorld(position_in_world);
  tag.lookat_in_site = SiteFromWorld(lookat_in_world);
  tag.aspect = 1.5;
  tag.view_angle_deg = 60;
  return tag;
}

SurveyPhotograph MakeSurveyPhotograph(const std::string& name,
                                      const Eigen::Vector3d& position_in_world,
                                      const Eigen::Vector3d& lookat_in_world) {
  SurveyPhotograph photograph;
  photograph.name = name;
  photograph.width_px = 600;
  photograph.height_px = 400;
  photograph.tag = TagAt(position_in_world, lookat_in_world);
  photograph.standing = "accepted";
  CameraParameters sigmas;
  sigmas << 0.05, 0.04, 0.03, 0.1, 0.08, 0.05, 0.1, 0.001, 0.001, 0.001, 0.002;
  photograph.covariance = CameraParameters(sigmas.array().square()).asDiagonal();
  // Position and direction go together, as they do where a camera was found by what it sees.
  photograph.covariance(kPositionX, kYaw) = photograph.covariance(kYaw, kPositionX) =
      0.7 * sigmas[kPositionX] * sigmas[kYaw];
  return photograph;
}

}  // namespace

Survey MakeWallSurvey() {
  Survey survey;
  PolygonModel& model = survey.model;
  model.sigma = 0.05;
  model.points_in_world = {{-20, 0, 0}, {20, 0, 0}, {20, 0, 20}, {-20, 0, 20}};
  model.faces.push_back({{0, 1, 2, 3}, "wall", 1});
  // The box's south and east sides.
  model.points_in_world.insert(
      model.points_in_world.end(),
      {{-2, -10, 0}, {2, -10, 0}, {2, -10, 4}, {-2, -10, 4}, {2, -6, 0}, {2, -6, 4}});
  model.faces.push_back({{4, 5, 6, 7}, "box south", 2});
  model.faces.push_back({{5, 8, 9, 6}, "box east", 3});
  survey.photographs = {MakeSurveyPhotograph("front", {0, -30, 5}, {0, 0, 5}),
                        MakeSurveyPhotograph("side", {20, -20, 5}, {0, 0, 5}),
                        MakeSurveyPhotograph("flat", {28, -1, 5}, {0, 0, 5}),
                        MakeSurveyPhotograph("back", {0, 30, 5}, {0, 0, 5}),
                        MakeSurveyPhotograph("away", {0, -30, 5}, {0, -60, 5})};
  survey.left_out.push_back({"lost", "rejected: the model is not in it"});
  return survey;
}

}  // namespace groundglass
