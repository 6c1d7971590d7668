// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "register/ties/colmap_database.h"

#include "scene/error.h"

#ifdef GROUNDGLASS_HAS_SQLITE

#include "scene/text.h"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

namespace groundglass {
namespace {

// What COLMAP (from 3.0 on) makes of two images' numbers in `pair_id`: this times the lower, plus
// the higher.
constexpr sqlite3_int64 kImagesAtMost = 2147483647;
constexpr int kOpencvModel = 4;
constexpr int kFullOpencvModel = 6;

}  // namespace

struct ColmapDatabase::Impl {
  std::filesystem::path file;
  sqlite3* connection = nullptr;
};

namespace {

[[noreturn]] void FailDatabase(const std::filesystem::path& file, const std::string& what) {
  throw Error(file,
              "cannot be read as COLMAP's database: " + OneLine(what) +
                  "; delete it, and it is made again");
}

// One statement of SQL, its parameters from 1.
class Statement {
 public:
  Statement(sqlite3* connection, const std::filesystem::path& file, const char* sql)
      : connection_(connection), file_(file) {
    if (sqlite3_prepare_v2(connection, sql, -1, &statement_, nullptr) != SQLITE_OK) Fail();
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void Bind(int parameter, const std::string& text) {
    Require(sqlite3_bind_text(
        statement_, parameter, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  }
  void Bind(int parameter, sqlite3_int64 number) {
    Require(sqlite3_bind_int64(statement_, parameter, number));
  }
  void Bind(int parameter, const std::vector<double>& numbers) {
    Require(sqlite3_bind_blob(statement_,
                              parameter,
                              numbers.data(),
                              static_cast<int>(numbers.size() * sizeof(double)),
                              SQLITE_TRANSIENT));
  }
  // To the next row; false if there is none.
  bool Next() {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) Fail();
    return result == SQLITE_ROW;
  }
  sqlite3_int64 Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  std::string Text(int column) const {
    const unsigned char* text = sqlite3_column_text(statement_, column);
    return text ? reinterpret_cast<const char*>(text) : "";
  }
  // rows x columns numbers, as the machine has them.
  template <typename Number>
  std::vector<Number> Numbers(int column, sqlite3_int64 num_rows, sqlite3_int64 num_columns) const {
    const auto num_bytes = static_cast<size_t>(sqlite3_column_bytes(statement_, column));
    const bool is_possible = num_rows >= 0 && num_rows < kImagesAtMost && num_columns >= 0 &&
                             num_columns <= 16 &&
                             num_bytes == num_rows * num_columns * sizeof(Number);
    if (!is_possible) {
      FailDatabase(file_, "a table of keypoints or matches has not the size that it says");
    }
    std::vector<Number> numbers(num_bytes / sizeof(Number));
    const void* bytes = sqlite3_column_blob(statement_, column);
    if (num_bytes > 0 && bytes) std::memcpy(numbers.data(), bytes, num_bytes);
    return numbers;
  }

 private:
  void Require(int result) const {
    if (result != SQLITE_OK) Fail();
  }
  [[noreturn]] void Fail() const { FailDatabase(file_, sqlite3_errmsg(connection_)); }

  sqlite3* connection_;
  const std::filesystem::path& file_;
  sqlite3_stmt* statement_ = nullptr;
};

std::vector<Keypoint> KeypointsOf(const Statement& row) {
  const sqlite3_int64 num_columns = row.Integer(1);
  const std::vector<float> numbers = row.Numbers<float>(2, row.Integer(0), num_columns);
  std::vector<Keypoint> keypoints;
  for (size_t i = 0; i + 1 < numbers.size(); i += num_columns) {
    Keypoint keypoint;
    keypoint.image_px = {numbers[i], numbers[i + 1]};
    // x y scale turn, or x y and the matrix of the blob's shape.
    if (num_columns == 4) keypoint.scale_px = numbers[i + 2];
    if (num_columns == 6) {
      keypoint.scale_px = 0.5 * (std::hypot(numbers[i + 2], numbers[i + 4]) +
                                 std::hypot(numbers[i + 3], numbers[i + 5]));
    }
    keypoints.push_back(keypoint);
  }
  return keypoints;
}

// The matches of a pair of images, the one with the lower number first, if both are wanted.
struct PairOfImages {
  int first = -1;  // as the caller numbers them
  int second = -1;
  bool is_turned = false;  // COLMAP numbers them the other way round
};

std::vector<std::pair<int, int>> MatchesOf(const Statement& row,
                                           const PairOfImages& pair,
                                           const FeatureMatches& matches,
                                           const std::filesystem::path& file) {
  const std::vector<uint32_t> numbers = row.Numbers<uint32_t>(2, row.Integer(1), 2);
  std::vector<std::pair<int, int>> found;
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) {
    uint32_t first = numbers[i];
    uint32_t second = numbers[i + 1];
    if (pair.is_turned) std::swap(first, second);
    if (first >= matches.keypoints[pair.first].size() ||
        second >= matches.keypoints[pair.second].size()) {
      FailDatabase(file, "a match names a keypoint that is not there");
    }
    found.emplace_back(first, second);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool ColmapDatabase::IsAvailable() { return true; }

ColmapDatabase::ColmapDatabase(const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>()) {
  impl_->file = file;
  const int result =
      sqlite3_open_v2(file.c_str(), &impl_->connection, SQLITE_OPEN_READWRITE, nullptr);
  if (result != SQLITE_OK) {
    const std::string what = impl_->connection ? sqlite3_errmsg(impl_->connection) : "no memory";
    sqlite3_close(impl_->connection);
    FailDatabase(file, what);
  }
  try {
    // COLMAP leaves its database in a mode that needs two more files beside it.
    Statement(impl_->connection, impl_->file, "PRAGMA journal_mode = DELETE").Next();
    Statement(impl_->connection,
              impl_->file,
              "CREATE TABLE IF NOT EXISTS groundglass_notes (name TEXT PRIMARY KEY, text TEXT)")
        .Next();
  } catch (const Error&) {
    sqlite3_close(impl_->connection);
    throw;
  }
}

ColmapDatabase::~ColmapDatabase() { sqlite3_close(impl_->connection); }

std::string ColmapDatabase::Note(const std::string& name) const {
  Statement notes(
      impl_->connection, impl_->file, "SELECT text FROM groundglass_notes WHERE name = ?");
  notes.Bind(1, name);
  return notes.Next() ? notes.Text(0) : "";
}

void ColmapDatabase::SetNote(const std::string& name, const std::string& text) {
  Statement insert(
      impl_->connection, impl_->file, "INSERT OR REPLACE INTO groundglass_notes VALUES (?, ?)");
  insert.Bind(1, name);
  insert.Bind(2, text);
  insert.Next();
}

void ColmapDatabase::SetCamera(const std::string& image, const Camera& camera) {
  const bool has_k3 = camera.k3 != 0;
  std::vector<double> numbers = {camera.focal_x_px,
                                 camera.focal_y_px,
                                 camera.center_x_px,
                                 camera.center_y_px,
                                 camera.k1,
                                 camera.k2,
                                 camera.p1,
                                 camera.p2};
  if (has_k3) numbers.insert(numbers.end(), {camera.k3, 0, 0, 0});
  Statement update(impl_->connection,
                   impl_->file,
                   "UPDATE cameras SET model = ?, params = ?, prior_focal_length = 1 WHERE "
                   "camera_id = (SELECT camera_id FROM images WHERE name = ?)");
  update.Bind(1, sqlite3_int64{has_k3 ? kFullOpencvModel : kOpencvModel});
  update.Bind(2, numbers);
  update.Bind(3, image);
  update.Next();
  if (sqlite3_changes(impl_->connection) != 1) {
    FailDatabase(impl_->file, "it has no image " + Quote(image));
  }
}

void ColmapDatabase::ForgetMatches() {
  for (const char* sql : {"DELETE FROM matches", "DELETE FROM two_view_geometries"}) {
    Statement(impl_->connection, impl_->file, sql).Next();
  }
}

FeatureMatches ColmapDatabase::ReadMatches(const std::vector<std::string>& images) const {
  FeatureMatches matches;
  std::map<sqlite3_int64, int> number_of_id;
  for (size_t i = 0; i < images.size(); ++i) {
    Statement image(impl_->connection, impl_->file, "SELECT image_id FROM images WHERE name = ?");
    image.Bind(1, images[i]);
    if (!image.Next()) FailDatabase(impl_->file, "it has no image " + Quote(images[i]));
    number_of_id[image.Integer(0)] = static_cast<int>(i);
    Statement keypoints(impl_->connection,
                        impl_->file,
                        "SELECT rows, cols, data FROM keypoints WHERE image_id = ?");
    keypoints.Bind(1, image.Integer(0));
    matches.keypoints.push_back(keypoints.Next() ? KeypointsOf(keypoints)
                                                 : std::vector<Keypoint>());
  }
  Statement pairs(impl_->connection,
                  impl_->file,
                  "SELECT pair_id, rows, data FROM two_view_geometries WHERE rows > 0");
  while (pairs.Next()) {
    const auto lower = number_of_id.find(pairs.Integer(0) / kImagesAtMost);
    const auto higher = number_of_id.find(pairs.Integer(0) % kImagesAtMost);
    if (lower == number_of_id.end() || higher == number_of_id.end()) continue;
    const auto [first, second] = std::minmax(lower->second, higher->second);
    const PairOfImages pair = {first, second, lower->second > higher->second};
    matches.pairs.push_back({first, second, MatchesOf(pairs, pair, matches, impl_->file)});
  }
  std::sort(matches.pairs.begin(), matches.pairs.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return matches;
}

}  // namespace groundglass

#else

namespace groundglass {

struct ColmapDatabase::Impl {};

namespace {

[[noreturn]] void FailWithoutSqlite(const std::filesystem::path& file) {
  throw Error(file,
              "this program was built without SQLite and cannot read COLMAP's database; install it "
              "(Debian: apt-get install libsqlite3-dev) and build again");
}

}  // namespace

bool ColmapDatabase::IsAvailable() { return false; }
ColmapDatabase::ColmapDatabase(const std::filesystem::path& file) { FailWithoutSqlite(file); }
ColmapDatabase::~ColmapDatabase() = default;
std::string ColmapDatabase::Note(const std::string&) const { return ""; }
void ColmapDatabase::SetNote(const std::string&, const std::string&) {}
void ColmapDatabase::SetCamera(const std::string&, const Camera&) {}
void ColmapDatabase::ForgetMatches() {}
FeatureMatches ColmapDatabase::ReadMatches(const std::vector<std::string>&) const { return {}; }

}  // namespace groundglass

#endif
