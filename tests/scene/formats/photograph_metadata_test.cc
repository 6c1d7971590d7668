// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/photograph_metadata.h"

#include "scene/formats/known_keys.h"
#include "scene/formats/metadata_lens.h"
#include "scene/formats/scene_folder.h"
#include "scene/formats/view_io.h"
#include "scene/frames.h"
#include "tests/scene/sample_scene_folder.h"
#include "tests/support/thrown_message.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace groundglass {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A JPEG that says of itself what `say` puts into its header.
void WritePhotograph(const std::filesystem::path& file,
                     const std::function<void(OIIO::ImageSpec&)>& say,
                     int width = 40,
                     int height = 30) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
  say(spec);
  std::filesystem::create_directories(file.parent_path());
  const auto output = OIIO::ImageOutput::create(file.string());
  const std::vector<uint8_t> pixels(static_cast<size_t>(width) * height * 3, 128);
  ASSERT_TRUE(output->open(file.string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixels.data()));
  ASSERT_TRUE(output->close());
}

void SayPlace(OIIO::ImageSpec& spec, double latitude_minutes, double longitude_minutes) {
  const float latitude[3] = {48, static_cast<float>(latitude_minutes), 0};
  const float longitude[3] = {2, static_cast<float>(longitude_minutes), 0};
  spec.attribute("GPS:Latitude", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), latitude);
  spec.attribute("GPS:Longitude", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), longitude);
  spec.attribute("GPS:LatitudeRef", "N");
  spec.attribute("GPS:LongitudeRef", "W");
}

// As every camera's pictures do: EXIF demands it.
void SayDigital(OIIO::ImageSpec& spec) {
  spec.attribute("Exif:PixelXDimension", 4000);
  spec.attribute("Exif:PixelYDimension", 3000);
}

class PhotographMetadataTest : public TemporaryFolder, public testing::Test {
 protected:
  PhotographMetadata Read(const std::function<void(OIIO::ImageSpec&)>& say) {
    WritePhotograph(path() / "p.jpg", say);
    return ReadPhotographMetadata(path() / "p.jpg");
  }
  MetadataLens LensOf(const std::function<void(OIIO::ImageSpec&)>& say) {
    return FindMetadataLens(Read(say), Options());
  }
  // No tables of sensors but the test's own.
  MetadataLensOptions Options() {
    MetadataLensOptions options;
    options.sensor_tables = path() / "tables";
    return options;
  }
};

TEST_F(PhotographMetadataTest, AFocalLengthFor35mmFilmCountsByTheDiagonal) {
  const MetadataLens lens = LensOf([](OIIO::ImageSpec& spec) {
    SayDigital(spec);
    spec.attribute("Exif:FocalLengthIn35mmFilm", 26);
    spec.attribute("Model", "Phone 12");
  });
  // 4:3 has 0.8 of its diagonal across; that of 36 mm x 24 mm is 43.267 mm.
  ASSERT_TRUE(lens.view_angle_deg);
  EXPECT_NEAR(*lens.view_angle_deg, 2 * std::atan(0.8 * 43.26661531 / 2 / 26) * 180 / M_PI, 1e-6);
  // 2 % of the lens, and a whole number of millimetres: 2 tan / (1 + tan^2) is the sine.
  const double share = std::hypot(0.02, 1 / std::sqrt(12.0) / 26);
  EXPECT_NEAR(
      lens.sigma_deg, share * std::sin(*lens.view_angle_deg * M_PI / 180) * 180 / M_PI, 1e-6);
  EXPECT_EQ(lens.how, "26 mm for 35 mm film (Phone 12)");
}

TEST_F(PhotographMetadataTest, AFocalPlaneResolutionTellsTheSensorsWidth) {
  // 40 pixels on 22.3 mm.
  const MetadataLens lens = LensOf([](OIIO::ImageSpec& spec) {
    spec.attribute("Exif:FocalLength", 18.0f);
    spec.attribute("Exif:FocalPlaneXResolution", 40 / 2.23f);
    spec.attribute("Exif:FocalPlaneResolutionUnit", 3);
    spec.attribute("Exif:PixelXDimension", 40);
    spec.attribute("Exif:PixelYDimension", 30);
  });
  ASSERT_TRUE(lens.view_angle_deg);
  EXPECT_NEAR(*lens.view_angle_deg, 2 * std::atan(22.3 / 2 / 18) * 180 / M_PI, 1e-3);
}

TEST_F(PhotographMetadataTest, NoMetadataAreOneLineAndNoGuess) {
  const MetadataLens lens = LensOf([](OIIO::ImageSpec&) {});
  EXPECT_FALSE(lens.view_angle_deg);
  EXPECT_EQ(lens.how, "the picture's metadata say no focal length");
}

TEST_F(PhotographMetadataTest, AFocalLengthForFilmThatCannotBeTheLensesIsNotBelieved) {
  const auto say = [](OIIO::ImageSpec& spec) {
    SayDigital(spec);
    spec.attribute("Exif:FocalLength", 500.0f);
    spec.attribute("Exif:FocalLengthIn35mmFilm", 5);
  };
  EXPECT_FALSE(LensOf(say).view_angle_deg);
  MetadataLensOptions options;
  options.least_crop_factor = 0;
  EXPECT_TRUE(FindMetadataLens(Read(say), options).view_angle_deg);
}

TEST_F(PhotographMetadataTest, AFocalLengthAloneAsksForTheSensor) {
  const auto say = [](OIIO::ImageSpec& spec) {
    spec.attribute("Exif:FocalLength", 18.0f);
    spec.attribute("Model", "D90");
  };
  EXPECT_THAT(LensOf(say).how, HasSubstr("not how large the sensor of the D90 is"));
  MetadataLensOptions options;
  options.sensor_width_mm = 36;
  const MetadataLens lens = FindMetadataLens(Read(say), options);
  ASSERT_TRUE(lens.view_angle_deg);
  EXPECT_NEAR(*lens.view_angle_deg, 90, 1e-6);
}

TEST_F(PhotographMetadataTest, ASensorsSizeComesFromLensfunsNewestTable) {
  const auto say = [](OIIO::ImageSpec& spec) {
    SayDigital(spec);
    spec.attribute("Exif:FocalLength", 18.0f);
    spec.attribute("Make", "NIKON CORPORATION");
    spec.attribute("Model", "NIKON D80");
  };
  EXPECT_THAT(LensOf(say).how, HasSubstr("install lensfun's table of cameras"));
  const auto table = [](const std::string& factor) {
    return "<lensdatabase version=\"1\"><camera><maker>Nikon Corporation</maker>"
           "<maker lang=\"en\">Nikon</maker><model>Nikon D80</model><model lang=\"en\">D80</model>"
           "<cropfactor>" +
           factor + "</cropfactor></camera><lens><cropfactor>9</cropfactor></lens></lensdatabase>";
  };
  // A folder is read once: another one for each table.
  MetadataLensOptions options = Options();
  options.sensor_tables = path() / "installed";
  Write("installed/version_0/slr.xml", table("7"));
  Write("installed/version_1/slr.xml", table("1.5"));
  const MetadataLens lens = FindMetadataLens(Read(say), options);
  ASSERT_TRUE(lens.view_angle_deg);
  // 27 mm for 35 mm film, whose diagonal is 43.27 mm; 4:3, so the width is 0.8 of the diagonal.
  const double half_tangent = 0.8 * std::hypot(36, 24) / 2 / 27;
  EXPECT_NEAR(*lens.view_angle_deg, DegreesFromRadians(2 * std::atan(half_tangent)), 1e-6);
  EXPECT_EQ(lens.how,
            "18 mm on a sensor 1.5 times smaller than 36 mm x 24 mm, by lensfun's table "
            "(NIKON CORPORATION NIKON D80)");
  // Two shares of the focal length, 2 and 1.5 %, together.
  EXPECT_NEAR(lens.sigma_deg,
              DegreesFromRadians(2 * half_tangent / (1 + half_tangent * half_tangent) * 0.025),
              1e-6);
  const auto say_other = [&](OIIO::ImageSpec& spec) {
    say(spec);
    spec.attribute("Model", "NIKON D9999");
  };
  EXPECT_THAT(FindMetadataLens(Read(say_other), options).how,
              HasSubstr("nor has lensfun's table it"));
}

// What a camera wrote is known better than what somebody wrote into the scan of a slide.
TEST_F(PhotographMetadataTest, AScanOfFilmIsKnownLessThanADigitalPhotograph) {
  const auto lens_of = [&](int width, int height, const std::function<void(OIIO::ImageSpec&)>& by) {
    WritePhotograph(
        path() / "s.jpg",
        [&](OIIO::ImageSpec& spec) {
          spec.attribute("Exif:FocalLength", 50.0f);
          spec.attribute("Exif:FocalLengthIn35mmFilm", 50);
          by(spec);
        },
        width,
        height);
    return FindMetadataLens(ReadPhotographMetadata(path() / "s.jpg"), Options());
  };
  const auto nobody = [](OIIO::ImageSpec&) {};
  const MetadataLens digital =
      lens_of(60, 40, [](OIIO::ImageSpec& spec) { spec.attribute("Exif:SensingMethod", 2); });
  const MetadataLens unknown = lens_of(60, 40, nobody);
  EXPECT_EQ(digital.how, "50 mm for 35 mm film");
  EXPECT_DOUBLE_EQ(digital.sigma_aspect_share, 0.001);
  EXPECT_THAT(unknown.how, HasSubstr(", perhaps scanned, since nothing says that a digital"));
  EXPECT_DOUBLE_EQ(*unknown.view_angle_deg, *digital.view_angle_deg);
  // 2 % of the lens and half a millimetre's rounding; 1 % of the mount besides.
  const double own = std::hypot(0.02, 1 / std::sqrt(12.0) / 50);
  EXPECT_NEAR(unknown.sigma_deg / digital.sigma_deg, std::hypot(own, 0.01) / own, 1e-9);
  EXPECT_NEAR(unknown.sigma_aspect_share, 0.0051, 1e-4);
  // A slide in a television frame, cropped or squeezed: 4:3 is 11.8 % from 3:2.
  const MetadataLens frame = lens_of(64, 48, nobody);
  EXPECT_THAT(frame.how, HasSubstr("; 64 x 48 is not the shape of 35 mm film"));
  EXPECT_NEAR(frame.sigma_aspect_share, 0.118, 0.001);
  // The whole width of 36 mm, or 32 mm of it: both within two deviations.
  for (const double width_mm : {36.0, 32.0}) {
    const double angle_deg = DegreesFromRadians(2 * std::atan(width_mm / 2 / 50));
    EXPECT_LT(std::abs(*frame.view_angle_deg - angle_deg), 2 * frame.sigma_deg);
  }
}

TEST_F(PhotographMetadataTest, ScannersAreKnownByTheirSigns) {
  const auto made_by = [&](const std::function<void(OIIO::ImageSpec&)>& say) {
    return Read([&](OIIO::ImageSpec& spec) {
             SayDigital(spec);
             say(spec);
           })
        .made_by;
  };
  EXPECT_EQ(made_by([](OIIO::ImageSpec&) {}), PictureMaker::kDigitalCamera);
  EXPECT_EQ(Read([](OIIO::ImageSpec&) {}).made_by, PictureMaker::kUnknown);
  const auto says = [&](const char* field, const char* text) {
    return made_by([&](OIIO::ImageSpec& spec) { spec.attribute(field, text); });
  };
  EXPECT_EQ(says("Software", "VueScan 9 x64"), PictureMaker::kScanner);
  EXPECT_EQ(says("Model", "CanoScan 9000F"), PictureMaker::kScanner);
  EXPECT_EQ(says("Software", "3d Scanner App"), PictureMaker::kDigitalCamera);
  EXPECT_EQ(says("Exif:DateTimeOriginal", "1988:07:01 12:00:00"), PictureMaker::kScanner);
  EXPECT_EQ(says("Exif:DateTimeOriginal", "2008:07:01 12:00:00"), PictureMaker::kDigitalCamera);
  EXPECT_EQ(made_by([](OIIO::ImageSpec& spec) { spec.attribute("Exif:SensingMethod", 8); }),
            PictureMaker::kScanner);
}

TEST_F(PhotographMetadataTest, BadFocalLengthsAreNamed) {
  EXPECT_EQ(LensOf([](OIIO::ImageSpec& spec) { spec.attribute("Exif:FocalLength", 0.0f); }).how,
            "the picture's metadata have a focal length of 0");
  EXPECT_THAT(LensOf([](OIIO::ImageSpec& spec) {
                spec.attribute("Exif:FocalLengthIn35mmFilm", 26);
                spec.attribute("Exif:DigitalZoomRatio", 2.0f);
              }).how,
              HasSubstr("digital zoom of 2"));
}

TEST_F(PhotographMetadataTest, CropsAndTurnsSinceAreHeeded) {
  const auto taken_as = [](int width, int height) {
    return [=](OIIO::ImageSpec& spec) {
      spec.attribute("Exif:FocalLengthIn35mmFilm", 26);
      spec.attribute("Exif:PixelXDimension", width);
      spec.attribute("Exif:PixelYDimension", height);
    };
  };
  const MetadataLens whole = LensOf(taken_as(4000, 3000));
  EXPECT_EQ(whole.how, "26 mm for 35 mm film");
  // An upright frame whose sides nobody exchanged in EXIF is the same frame.
  const MetadataLens turned = LensOf(taken_as(3000, 4000));
  EXPECT_THAT(turned.how, HasSubstr("turned since it was taken"));
  EXPECT_DOUBLE_EQ(*turned.view_angle_deg, *whole.view_angle_deg);
  // Of 50 x 30 pixels 40 x 30 are left: the scale is the frame's.
  const MetadataLens cropped = LensOf(taken_as(50, 30));
  EXPECT_NEAR(*cropped.view_angle_deg,
              2 * std::atan(20 / (26 / 43.26661531 * std::hypot(50, 30))) * 180 / M_PI,
              1e-6);
  EXPECT_THAT(LensOf(taken_as(55, 33)).how, HasSubstr("cropped since it was taken (55 x 33)"));
  EXPECT_FALSE(LensOf(taken_as(55, 33)).view_angle_deg);
}

TEST_F(PhotographMetadataTest, AGpsPositionHasItsSignsAndItsHeight) {
  const PhotographMetadata metadata = Read([](OIIO::ImageSpec& spec) {
    SayPlace(spec, 30, 15);
    spec.attribute("GPS:Altitude", 35.5f);
    spec.attribute("GPS:ImgDirection", 123.25f);
    spec.attribute("GPS:ImgDirectionRef", "M");
  });
  ASSERT_TRUE(metadata.gps);
  EXPECT_DOUBLE_EQ(metadata.gps->latitude_deg, 48.5);
  EXPECT_DOUBLE_EQ(metadata.gps->longitude_deg, -2.25);
  EXPECT_DOUBLE_EQ(*metadata.gps->height_m, 35.5);
  EXPECT_DOUBLE_EQ(*metadata.direction.bearing_deg, 123.25);
  EXPECT_TRUE(metadata.direction.is_bearing_magnetic);
  EXPECT_THAT(metadata.faults, IsEmpty());
}

TEST_F(PhotographMetadataTest, NullIslandIsNoPlace) {
  const PhotographMetadata metadata = Read([](OIIO::ImageSpec& spec) {
    SayPlace(spec, 0, 0);
    const float zeros[3] = {0, 0, 0};
    spec.attribute("GPS:Latitude", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), zeros);
    spec.attribute("GPS:Longitude", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), zeros);
  });
  EXPECT_FALSE(metadata.gps);
  EXPECT_THAT(metadata.faults,
              ElementsAre("GPS position at 0 N 0 E, in the sea off Africa: the receiver had no "
                          "fix"));
}

TEST(SceneCalibration, ADigitalPhotographNeedsNoViewAngleInItsTag) {
  SceneFolder folder;
  folder.Write("views/s2.view", "x 5 y 20 z 2\ni 5 j 0 k 2\n");
  WritePhotograph(
      folder.path() / "images/s2.jpg",
      [](OIIO::ImageSpec& spec) {
        spec.attribute("Exif:FocalLengthIn35mmFilm", 26);
        spec.attribute("Exif:PixelXDimension", 30);
        spec.attribute("Exif:PixelYDimension", 20);
      },
      30,
      20);
  const Scene scene = ReadScene(folder.path());
  ASSERT_EQ(scene.photographs.size(), 2u);
  EXPECT_NEAR(scene.photographs[0].tag.view_angle_deg, 2 * std::atan(18.0 / 26) * 180 / M_PI, 1e-9);
  EXPECT_DOUBLE_EQ(scene.photographs[0].tag.aspect, 1.5);
  EXPECT_GT(scene.photographs[0].tag.sigmas.view_angle_deg, 1.0);
  EXPECT_EQ(scene.photographs[1].tag.view_angle_deg, 40);
  EXPECT_THAT(scene.notes,
              ElementsAre("s2: a v from the pictures' own metadata, 26 mm for 35 mm film"));
}

}  // namespace
}  // namespace groundglass
