// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
// Internal to session.
#pragma once

#include "scene/polygon_model.h"
#include "scene/view_tag.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace groundglass {

// The text of a scene's tags.csv (docs/scene-folder.md), one row of which is changed at a time:
// every other byte stays, whatever separator, decimal mark, quotes, comments and line ends it has.
class TagsTable {
 public:
  // bytes: what the file holds. Throws Error for a table that cannot be read, or whose bytes are
  // not UTF-8, of which this class keeps its hands.
  TagsTable(const std::filesystem::path& file, const std::string& bytes);

  // A photograph's row as it stands, without its line break; nothing if it has none.
  std::optional<std::string> Row(const std::string& photograph) const;
  // The table's bytes with this row in place of the photograph's, behind all others if it has none;
  // nothing: without its row.
  std::string With(const std::string& photograph, const std::optional<std::string>& row) const;

  // The reason that a row says its tag was taken for; empty if none.
  static std::string ReasonOf(const std::string& row);

  // The photograph's row with the tag's numbers in their fields, which keep the rest of their bytes
  // where the number is the same; a comment at its end says why the tag was taken, if reason is not
  // empty. Throws Error if the table has no column for a number that the tag needs, naming them, or
  // has places as latitudes.
  std::string FormatRow(const std::string& photograph,
                        const ViewTag& tag,
                        const std::string& reason) const;
  // The tag's standard deviations that the table has no column for, and so does not keep:
  // "sigma_position,sigma_height"; empty if none.
  std::string SigmasWithoutColumn(const ViewTag& tag) const;

 private:
  struct Span {
    size_t begin = 0;
    size_t end = 0;
  };
  struct Record {
    Span text;                 // without the line break
    size_t next = 0;           // where the next one begins
    std::vector<Span> fields;  // without blanks at either end
    size_t comment = 0;        // where it begins; at text.end if there is none
  };
  std::vector<Record> Split(const std::string& text) const;
  const Record* Find(const std::string& photograph) const;
  std::string Field(const Record& record, size_t column) const;
  std::optional<double> NumberIn(const std::string& field) const;
  std::string Number(double value) const;
  std::string NameField(const std::string& photograph) const;
  std::map<std::string, double> ValuesOf(const ViewTag& tag) const;

  std::filesystem::path file_;
  std::string bytes_;
  char separator_ = ',';
  char decimal_mark_ = '.';  // as DecimalMarkOf
  std::string line_break_;
  std::vector<Record> records_;
  std::vector<std::string> header_;
};

}  // namespace groundglass
