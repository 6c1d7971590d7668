// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "tests/register/ties/colmap_file.h"

#include <sqlite3.h>

#include <cstring>
#include <stdexcept>

namespace groundglass {
namespace {

void Require(bool is_good, sqlite3* connection) {
  if (!is_good) throw std::runtime_error(sqlite3_errmsg(connection));
}

void Execute(sqlite3* connection, const std::string& sql) {
  Require(sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK,
          connection);
}

std::string HexOf(const void* bytes, size_t size) {
  static const char* digits = "0123456789abcdef";
  std::string text = "x'";
  for (size_t i = 0; i < size; ++i) {
    const auto byte = static_cast<const unsigned char*>(bytes)[i];
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text + "'";
}

template <typename Number>
std::string BlobOf(const std::vector<Number>& numbers) {
  return HexOf(numbers.data(), numbers.size() * sizeof(Number));
}

}  // namespace

void WriteColmapFile(const std::filesystem::path& file,
                     const std::vector<ColmapFileImage>& images,
                     const std::vector<ColmapFilePair>& pairs) {
  sqlite3* connection = nullptr;
  Require(sqlite3_open(file.c_str(), &connection) == SQLITE_OK, connection);
  Execute(connection,
          "CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY, model INTEGER, width INTEGER, "
          "height INTEGER, params BLOB, prior_focal_length INTEGER);"
          "CREATE TABLE images (image_id INTEGER PRIMARY KEY, name TEXT, camera_id INTEGER);"
          "CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, "
          "data BLOB);"
          "CREATE TABLE matches (pair_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, "
          "data BLOB);"
          "CREATE TABLE two_view_geometries (pair_id INTEGER PRIMARY KEY, rows INTEGER, cols "
          "INTEGER, data BLOB, config INTEGER)");
  for (const ColmapFileImage& image : images) {
    const std::string id = std::to_string(image.id);
    Execute(connection, "INSERT INTO cameras VALUES (" + id + ", 2, 600, 400, x'', 0)");
    Execute(connection, "INSERT INTO images VALUES (" + id + ", '" + image.name + "', " + id + ")");
    Execute(connection,
            "INSERT INTO keypoints VALUES (" + id + ", " +
                std::to_string(image.keypoints.size() / image.num_columns) + ", " +
                std::to_string(image.num_columns) + ", " + BlobOf(image.keypoints) + ")");
  }
  for (const ColmapFilePair& pair : pairs) {
    const std::string id = std::to_string(2147483647LL * pair.lower_id + pair.higher_id);
    const std::string rows = std::to_string(pair.matches.size() / 2);
    Execute(connection,
            "INSERT INTO two_view_geometries VALUES (" + id + ", " + rows + ", 2, " +
                BlobOf(pair.matches) + ", 2)");
  }
  sqlite3_close(connection);
}

ColmapFileCamera ReadColmapFileCamera(const std::filesystem::path& file, const std::string& image) {
  sqlite3* connection = nullptr;
  Require(sqlite3_open(file.c_str(), &connection) == SQLITE_OK, connection);
  const std::string sql =
      "SELECT model, prior_focal_length, params FROM cameras JOIN images USING (camera_id) WHERE "
      "name = '" +
      image + "'";
  sqlite3_stmt* statement = nullptr;
  Require(sqlite3_prepare_v2(connection, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK,
          connection);
  Require(sqlite3_step(statement) == SQLITE_ROW, connection);
  ColmapFileCamera camera;
  camera.model = sqlite3_column_int(statement, 0);
  camera.is_prior = sqlite3_column_int(statement, 1) != 0;
  camera.parameters.resize(sqlite3_column_bytes(statement, 2) / sizeof(double));
  std::memcpy(camera.parameters.data(),
              sqlite3_column_blob(statement, 2),
              camera.parameters.size() * sizeof(double));
  sqlite3_finalize(statement);
  sqlite3_close(connection);
  return camera;
}

}  // namespace groundglass
