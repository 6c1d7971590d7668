// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace groundglass {

// A table as spreadsheets of any country save it: columns parted by comma, semicolon or tab, found
// out from the header (or an Excel line "sep=;"); quotes, in which a doubled quote stands for
// itself; decimal points or commas; UTF-8, UTF-16 or Windows-1252; any line ends; empty columns and
// rows at the ends dropped. From a blank and `%` on, or a line's first `%`, a row is a comment.
//
// Ours, since the libraries for CSV (libcsv, fast-cpp-csv-parser, rapidcsv) are told the separator,
// and leave encoding, decimal commas and the place of a fault to their caller, which is nearly all
// of this.
struct CsvRow {
  int line = 0;                     // where it begins, from 1
  std::vector<std::string> fields;  // without blanks at either end; as many as the header has
  std::string fault;                // if they are not as many
};

class CsvTable {
 public:
  // Throws Error where it is no text (a spreadsheet's own file, UTF-32, zeros), or each line is one
  // field in quotes; and FILE:LINE: for quotes that are not closed, or a row with more or fewer
  // fields than the header has, unless `faults` is given: then the first are lines there, and the
  // second are kept with their fault.
  CsvTable(const std::filesystem::path& file, std::vector<std::string>* faults = nullptr);

  const std::vector<std::string>& header() const { return header_; }  // in lower case
  int header_line() const { return header_line_; }                    // 0: the file has none
  const std::vector<CsvRow>& rows() const { return rows_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  // A field's number, with a decimal point or comma, thousands parted or not; infinite if it is
  // too large. Nothing if it is no number, or if nobody can tell which one (why_not says so).
  std::optional<double> Number(std::string_view field, std::string* why_not = nullptr) const;
  char decimal_mark() const { return decimal_mark_; }  // '?' if what the table holds does not tell

 private:
  struct Record;
  std::vector<Record> SplitRecords(std::string_view text) const;

  std::filesystem::path file_;
  char separator_ = ',';
  char decimal_mark_ = '.';  // '?' if what the table holds does not tell
  std::vector<std::string> header_;
  int header_line_ = 0;
  std::vector<CsvRow> rows_;
  std::vector<std::string> warnings_;
};

// What parts whole numbers from their decimals: '.' or ',', as those of a table's fields tell that
// can be read in one way only; '?' if they do not agree, or nobody can tell.
char DecimalMarkOf(const std::vector<std::string>& fields, char separator);

// A field as it is written between commas: one with a comma, a quotation mark or a line end stands
// in quotation marks (RFC 4180).
std::string CsvField(std::string_view text);

}  // namespace groundglass
