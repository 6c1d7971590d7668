// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "exchange/camera_exchange.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/image_io.h"
#include "scene/formats/registration_io.h"
#include "tests/exchange/test_camera.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace groundglass {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

ExchangeSource OnePhotograph(const TemporaryFolder& folder) {
  WriteSrgb8(folder / "photos/s3.jpg", Image8(300, 200, 3, 128));
  ExchangeSource source;
  source.images = folder / "photos";
  source.cameras = {{"s3.jpg", ResizedCamera(OffCentreCamera(), 300, 200)}};
  return source;
}

TEST(ExportFolder, FormatsWhosePicturesDifferDoNotShareOne) {
  const TemporaryFolder folder;
  const ExchangeSource source = OnePhotograph(folder);
  WriteCamerasAs("mvs-texturing", source, folder / "two");
  const ImageSize before = ReadImageSize(folder / "two/s3.jpg");
  for (const char* other : {"realitycapture", "realitycapture-csv", "fspy"}) {
    EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs(other, source, folder / "two"); }),
                HasSubstr("two: holds cameras for mvs-texturing (s3.cam)"))
        << other;
  }
  EXPECT_EQ(ReadImageSize(folder / "two/s3.jpg").width, before.width);
  // The same once more, and what has no names of its own there.
  WriteCamerasAs("mvs-texturing", source, folder / "two");
  WriteCamerasAs("colmap", source, folder / "two");
  WriteCamerasAs("colmap-binary", source, folder / "two");
}

TEST(ExportFolder, SidecarsAreNotExchangedForOthers) {
  const TemporaryFolder folder;
  const ExchangeSource source = OnePhotograph(folder);
  WriteCamerasAs("realitycapture", source, folder / "rc");
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("xmp", source, folder / "rc"); }),
              HasSubstr("holds cameras for realitycapture (s3.xmp)"));
  WriteCamerasAs("xmp", source, folder / "sidecars");
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("realitycapture", source, folder / "sidecars"); }),
              HasSubstr("holds cameras for xmp (s3.xmp)"));
  WriteCamerasAs("fspy", source, folder / "sidecars");
}

TEST(ExportFolder, WithoutAPlaceOnEarthNoPictureIsWritten) {
  const TemporaryFolder folder;
  const ExchangeSource source = OnePhotograph(folder);
  EXPECT_THAT(ThrownMessage([&] { WriteCamerasAs("kml", source, folder / "globe/s.kml"); }),
              HasSubstr("does not say where on Earth it is"));
  EXPECT_FALSE(std::filesystem::exists(folder / "globe"));
}

TEST(ExportFolder, CamerasOfRejectedPhotographsAreLeftOut) {
  const TemporaryFolder folder;
  ExchangeSource source = OnePhotograph(folder);
  source.cameras.push_back(source.cameras[0]);
  source.cameras[1].name = "well.jpg";
  std::vector<Registration> registrations(2);
  for (size_t i = 0; i < registrations.size(); ++i) {
    registrations[i].width_px = 300;
    registrations[i].height_px = 200;
    registrations[i].measured.lookat_in_site = {0, -5, 1};
    registrations[i].corrected = registrations[i].measured;
  }
  registrations[0].name = "s3";
  registrations[0].verdict = Verdict::kReview;
  registrations[1].name = "well";
  registrations[1].verdict = Verdict::kRejected;
  const std::filesystem::path out = folder / "out";
  WriteCamerasAs("colmap", source, out / "cameras");
  WriteFileAtomically(out / "registration.json", FormatRegistrations(registrations));
  const ExchangeSource read = ReadExchangeSource(out, folder / "photos");
  ASSERT_EQ(read.cameras.size(), 1);
  EXPECT_EQ(read.cameras[0].name, "s3.jpg");
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("rejected: well;")));

  registrations[0].verdict = Verdict::kRejected;
  WriteFileAtomically(out / "registration.json", FormatRegistrations(registrations));
  EXPECT_THAT(ThrownMessage([&] { ReadExchangeSource(out, folder / "photos"); }),
              HasSubstr("no camera is left: left out, since their photographs are rejected: s3"));
}

}  // namespace
}  // namespace groundglass
