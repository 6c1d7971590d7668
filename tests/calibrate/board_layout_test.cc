// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Boards that are numbered, turned and bordered in other ways than ours.
#include "calibrate/board_layout.h"

#include "calibrate/calibrate_board.h"
#include "scene/formats/image_io.h"
#include "scene/frames.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace groundglass {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// What a detector would tell of the board, seen three times, with the AprilTags' own corners.
std::vector<std::vector<AprilTagDetection>> See(const Board& board) {
  std::vector<std::vector<AprilTagDetection>> detections;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.4 * i - 0.3, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(0.2 + 0.3 * i, Eigen::Vector3d::UnitZ()))
                                     .toRotationMatrix();
    std::vector<AprilTagDetection>& april_tags = detections.emplace_back();
    for (int index = i; index < board.columns * board.rows; ++index) {
      AprilTagDetection& april_tag = april_tags.emplace_back();
      april_tag.id = board.first_id + index;
      april_tag.border_cells = board.border_cells;
      const Eigen::Matrix<double, 2, 4> corners = AprilTagCornersOnBoard(board, index);
      for (int corner = 0; corner < 4; ++corner) {
        Eigen::Vector3d in_cam = turn * Eigen::Vector3d(corners(0, corner), corners(1, corner), 0);
        in_cam.z() += 20 * board.april_tag_size;
        april_tag.corners_px.col(corner) =
            Eigen::Vector2d(400, 300) + 700 * in_cam.head<2>() / in_cam.z();
      }
    }
  }
  return detections;
}

TEST(BoardLayout, EveryOrderOfTheNumbersIsFound) {
  for (int i = 0; i < 8; ++i) {
    Board board;  // 6 x 4
    Eigen::Matrix2i& grid = board.numbering.grid_from_count;
    const int x = (i & 1) != 0 ? -1 : 1;
    const int y = (i & 2) != 0 ? -1 : 1;
    grid << x, 0, 0, y;
    if ((i & 4) != 0) grid << 0, y, x, 0;
    for (const int stride : {6, 4}) {
      board.numbering.stride = stride;
      auto detections = See(board);
      const Board found = FindBoardLayout(Board{}, detections);
      EXPECT_EQ(found.numbering.grid_from_count, grid) << i << " " << stride;
      EXPECT_EQ(found.numbering.stride, stride) << i;
    }
  }
}

TEST(BoardLayout, OpenCvsTurnedTagsAreNumberedFromTheBottomRight) {
  Board board;
  board.numbering.grid_from_count = -Eigen::Matrix2i::Identity();
  auto detections = See(board);
  EXPECT_THAT(DescribeLayout(FindBoardLayout(Board{}, detections)),
              HasSubstr("numbered along the rows from the bottom right (as the tags stand)"));
  detections = See(Board{});
  EXPECT_EQ(DescribeLayout(FindBoardLayout(Board{}, detections)), "");
}

TEST(BoardLayout, TellsWhichBoardIsToBeSeen) {
  Board board;
  board.columns = 5;
  board.rows = 7;
  board.first_id = 40;
  board.april_tag_size = 8;
  board.gap = 2.4;
  Board given;
  given.april_tag_size = 8;
  given.gap = 2;
  EXPECT_THAT(DescribeSeenBoard(given, See(board)),
              HasSubstr("tags 40 to 74 of tag36h11 in rows of 5, with a gap of 0.3 of the tag's "
                        "size: --columns 5 --rows 7 --first-id 40 --tag-size 8 --gap 2.4"));
}

std::vector<BoardPhotograph> KalibrPhotographs() {
  const std::string folder = std::string(GROUNDGLASS_SOURCE_DIR) + "/tests/data/kalibr_board/";
  std::vector<BoardPhotograph> photographs;
  for (const char* name : {"k1.jpg", "k2.jpg", "k3.jpg"}) {
    photographs.push_back({name, ReadGrey8(folder + name)});
  }
  return photographs;
}

TEST(CalibrateBoard, ReadsKalibrsBoard) {
  Board board;
  board.columns = board.rows = 6;
  board.april_tag_size = 0.088;
  board.gap = 0.0264;
  const BoardResult result = CalibrateBoard(KalibrPhotographs(), board);
  EXPECT_THAT(result.layout,
              AllOf(HasSubstr("a border of two cells, as Kalibr draws them"),
                    HasSubstr("numbered along the rows from the bottom left")));
  EXPECT_LT(result.rms_px, 0.25);  // of JPEGs; 0.213 measured
  EXPECT_GT(result.num_corners, 4 * 90);
  EXPECT_NEAR(result.lens.aspect, 800.0 / 533, 0.005);
}

TEST(CalibrateBoard, SaysWhatKalibrsBoardIsIfItIsDescribedWrongly) {
  Board as_printed;  // ours: 6 x 4, a gap of a quarter, which fits to a pixel or so
  EXPECT_THAT(CalibrateBoard(KalibrPhotographs(), as_printed).remarks,
              testing::Contains(
                  HasSubstr("tags 0 to 35 of tag36h11 in rows of 6, with a gap of 0.3 of the tag's "
                            "size: --columns 6 --rows 6")));
  EXPECT_TRUE(CalibrateBoard(KalibrPhotographs(), as_printed).shows_other_board);
  Board ratio;
  ratio.april_tag_size = 0.088;
  ratio.gap = 0.3;
  EXPECT_THAT(ThrownMessage([&] { ratio.Check(); }),
              HasSubstr("if 0.3 is its ratio to the tag size, as Kalibr's tagSpacing, give --gap "
                        "0.0264"));
}

TEST(CalibrateBoard, SaysWhatElseThePicturesShow) {
  const auto message = [](const Image8& picture) {
    const std::vector<BoardPhotograph> photographs(3, {"p.jpg", picture});
    return ThrownMessage([&] { CalibrateBoard(photographs, Board{}); });
  };
  Board small;
  small.columns = small.rows = 3;
  const Image8 print = DrawBoard(small);
  Image8 picture = print;
  for (int y = 0; y < picture.height; ++y) {
    std::reverse(picture.At(0, y), picture.At(0, y) + picture.width);
  }
  EXPECT_THAT(message(picture),
              AllOf(HasSubstr("0 of 3 photographs show the board"), HasSubstr("are mirrored")));
  picture = print;
  for (uint8_t& value : picture.values) value = static_cast<uint8_t>(255 - value);
  EXPECT_THAT(message(picture), HasSubstr("the pictures are negatives"));
  EXPECT_THAT(message(Image8(300, 200, 1, 128)), HasSubstr("no AprilTags are to be seen"));

  apriltag_family_t* family = tag25h9_create();
  Image8 other(600, 400, 1, 255);
  for (int april_tag = 0; april_tag < 6; ++april_tag) {
    image_u8_t* drawn = apriltag_to_image(family, april_tag);
    constexpr int kCellPx = 14;
    for (int y = 0; y < drawn->height * kCellPx; ++y) {
      for (int x = 0; x < drawn->width * kCellPx; ++x) {
        *other.At(20 + april_tag % 3 * 190 + x, 20 + april_tag / 3 * 190 + y) =
            drawn->buf[y / kCellPx * drawn->stride + x / kCellPx];
      }
    }
    // The library does not export image_u8_destroy.
    std::free(drawn->buf);
    std::free(drawn);
  }
  tag25h9_destroy(family);
  EXPECT_THAT(message(other), HasSubstr("the pictures show tags of the family tag25h9"));
}

TEST(KalibrTarget, IsRead) {
  const TemporaryFolder folder;
  const Board board = ReadKalibrTarget(
      folder.Write("april.yaml",
                   "target_type: 'aprilgrid' #gridtype\ntagCols: 6  #number\ntagRows: 5\n"
                   "tagSize: 0.088\ntagSpacing: 0.3  # ratio\ncodeOffset: 0\n"));
  EXPECT_EQ(board.columns, 6);
  EXPECT_EQ(board.rows, 5);
  EXPECT_EQ(board.april_tag_size, 0.088);
  EXPECT_NEAR(board.gap, 0.0264, 1e-12);
  EXPECT_THAT(ThrownMessage([&] {
                ReadKalibrTarget(folder.Write("c.yaml", "target_type: 'checkerboard'\n"));
              }),
              HasSubstr("c.yaml: expected Kalibr's target_type: 'aprilgrid', not 'checkerboard'"));
  EXPECT_THAT(ThrownMessage([&] {
                ReadKalibrTarget(
                    folder.Write("d.yaml", "target_type: aprilgrid\ntagCols: 6\ntagRows: six\n"));
              }),
              HasSubstr("d.yaml:3: key 'tagRows': 'six' is not a number above 0"));
}

}  // namespace
}  // namespace groundglass
