// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/bench/anchors/visp_edge_tracker.h"

#include <visp/vpCameraParameters.h>
#include <visp/vpHomogeneousMatrix.h>
#include <visp/vpImage.h>
#include <visp/vpMbGenericTracker.h>
#include <visp/vpMe.h>

#include <algorithm>
#include <iostream>

namespace groundglass {
namespace {

// Loading a model prints what is in it, and tracking what it finds odd.
class Quiet {
 public:
  explicit Quiet(std::ostream& stream) : stream_(stream), buffer_(stream.rdbuf(nullptr)) {}
  ~Quiet() {
    stream_.rdbuf(buffer_);
    stream_.clear();
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::ostream& stream_;
  std::streambuf* buffer_;
};

}  // namespace

VispPose TrackWithVisp(const VispTracking& tracking, const VispPose& start) {
  vpImage<unsigned char> image(tracking.height_px, tracking.width_px);
  std::copy_n(tracking.grey8, tracking.width_px * tracking.height_px, image.bitmap);
  vpHomogeneousMatrix pose;
  for (int i = 0; i < 12; ++i) pose[i / 4][i % 4] = start[i];
  VispPose found = start;
  const Quiet quiet_output(std::cout);
  const Quiet quiet_errors(std::cerr);
  try {
    for (const int range_px : tracking.ranges_px) {
      vpMbGenericTracker tracker(1, vpMbGenericTracker::EDGE_TRACKER);
      vpMe me;
      me.setMaskSize(5);
      me.setMaskNumber(180);
      me.setRange(range_px);
      me.setThreshold(tracking.edge_threshold);
      me.setMu1(0.5);
      me.setMu2(0.5);
      me.setSampleStep(4);
      tracker.setMovingEdge(me);
      vpCameraParameters lens;
      lens.initPersProjWithoutDistortion(
          tracking.focal_x_px, tracking.focal_y_px, tracking.center_x_px, tracking.center_y_px);
      tracker.setCameraParameters(lens);
      tracker.setAngleAppear(vpMath::rad(85));
      tracker.setAngleDisappear(vpMath::rad(89));
      tracker.setDisplayFeatures(false);
      tracker.setScanLineVisibilityTest(tracking.with_scan_lines);
      // Lost only where almost no site is left.
      tracker.setGoodMovingEdgesRatioThreshold(0.05);
      tracker.loadModel(tracking.cao_file);
      tracker.initFromPose(image, pose);
      for (int i = 0; i < tracking.repeats; ++i) {
        tracker.track(image);
        tracker.getPose(pose);
        for (int k = 0; k < 12; ++k) found[k] = pose[k / 4][k % 4];
      }
    }
  } catch (const vpException&) {
    // The tracker says that it is lost: what it had last stands.
  }
  return found;
}

}  // namespace groundglass
