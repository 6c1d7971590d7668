// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "scene/formats/csv.h"

#include "scene/error.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/formats/view_io.h"
#include "scene/text.h"

#include <algorithm>
#include <cstddef>

namespace groundglass {

// A row as it stands in the file.
struct CsvTable::Record {
  int line = 0;
  std::vector<std::string> fields;
  bool is_open = false;  // its last quotes are not closed

  bool IsEmpty() const {
    return std::all_of(
        fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); });
  }
};

namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

constexpr const char* kSaveAsCsv =
    "open it in a spreadsheet and save it as CSV (Save As, CSV UTF-8)";

// What a file is in place of a table in text, and what to do; empty if it may be one. `text`: its
// bytes as UTF-8.
std::string WhyNoTable(const std::filesystem::path& file,
                       std::string_view bytes,
                       std::string_view text) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("PK\x03\x04"sv)) {
    return std::string(
               "this is an Excel or LibreOffice file, or another zip archive, and no text; ") +
           kSaveAsCsv;
  }
  if (bytes.starts_with("\xD0\xCF\x11\xE0"sv)) {
    return std::string("this is an Excel file (.xls) and no text; ") + kSaveAsCsv;
  }
  const bool is_utf32 = bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv);
  const bool is_unmarked_utf32 =
      bytes.size() >= 8 && (bytes.substr(1, 3) == "\0\0\0"sv || bytes.substr(0, 3) == "\0\0\0"sv) &&
      (bytes.substr(5, 3) == "\0\0\0"sv || bytes.substr(4, 3) == "\0\0\0"sv) &&
      bytes.find_first_not_of('\0') < 4;
  if (is_utf32 || is_unmarked_utf32) return "this is text in UTF-32; save it as UTF-8";
  const size_t zero = text.find('\0');
  if (zero != std::string_view::npos || text.starts_with("%PDF") || text.starts_with("<")) {
    const ImageKind kind = FindImageKind(file);
    if (kind.description == "a web page") {
      return "this is a web page and no table; save the table itself, as CSV";
    }
    if (kind.description == "a file of zeros")
      return "this is " + kind.description + "; " + kind.remedy;
    if (kind.description == "a PDF" || kind.IsImage()) {
      return "this is " + kind.description + " and no table in text; " + kSaveAsCsv;
    }
  }
  if (zero == std::string_view::npos) return "";
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
  const bool only_zeros_follow = text.find_first_not_of('\0', zero) == std::string_view::npos;
  return (only_zeros_follow ? "from line " : "line ") + std::to_string(line + 1) +
         (only_zeros_follow
              ? " on it holds nothing but zeros (NUL), as after a copy that was interrupted: lines "
                "may be lost; copy it again, or save it anew"
              : " holds zeros (NUL), which no text has; save it anew as CSV in UTF-8");
}

// Blanks that people and spreadsheets put into numbers and names: as plain ones; so are bytes that
// no terminal should be sent.
std::string WithPlainBlanks(std::string_view text) {
  std::string plain;
  for (size_t at = 0; at < text.size();) {
    const auto starts = [&](std::string_view what) { return text.substr(at, what.size()) == what; };
    if (starts("\xC2\xA0")) {  // no-break space
      plain += ' ';
      at += 2;
    } else if (starts("\xE2\x80\xAF") || starts("\xE2\x80\x89")) {  // narrow, thin
      plain += ' ';
      at += 3;
    } else if (starts("\xE2\x88\x92")) {  // minus
      plain += '-';
      at += 3;
    } else {
      const char c = text[at++];
      const bool is_control = (static_cast<unsigned char>(c) < ' ' && c != '\t') || c == '\x7F';
      plain += is_control ? ' ' : c;
    }
  }
  return plain;
}

// A number's text, taken apart: sign, digits in groups parted by marks, exponent.
struct NumberText {
  bool is_one = false;
  int num_points = 0;
  int num_commas = 0;
  char last_mark = 0;            // '.' or ','
  bool is_in_thousands = false;  // 1 to 3 digits, then groups of 3
  std::string without_blanks;    // and apostrophes, which only part thousands
};

NumberText TakeApart(std::string_view field) {
  NumberText number;
  std::string text = WithPlainBlanks(field);
  const size_t exponent = text.find_first_of("eE");
  size_t group = 0;
  size_t num_groups = 0;
  bool groups_are_three = true;
  bool has_digit = false;
  for (size_t i = 0; i < std::min(exponent, text.size()); ++i) {
    const char c = text[i];
    if (IsDigit(c)) {
      ++group;
      has_digit = true;
      number.without_blanks += c;
      continue;
    }
    if ((c == '-' || c == '+') && i == 0) {
      number.without_blanks += c;
      continue;
    }
    const bool parts_thousands = c == ' ' || c == '\'';
    if (!parts_thousands && c != '.' && c != ',') return {};
    if (parts_thousands && (group == 0 || number.last_mark != 0)) return {};
    groups_are_three =
        groups_are_three && (num_groups == 0 ? group >= 1 && group <= 3 : group == 3);
    if (parts_thousands && !groups_are_three) return {};
    ++num_groups;
    group = 0;
    if (parts_thousands) {
      if (i + 3 >= text.size() || !IsDigit(text[i + 3])) return {};
      continue;
    }
    number.last_mark = c;
    (c == '.' ? number.num_points : number.num_commas) += 1;
    number.without_blanks += c;
  }
  if (!has_digit) return {};
  number.is_in_thousands = number.last_mark != 0 && groups_are_three && group == 3;
  if (exponent != std::string::npos) number.without_blanks += text.substr(exponent);
  number.is_one = true;
  return number;
}

// The number with this decimal mark; the other mark parts thousands.
std::optional<double> Parse(const NumberText& number, char decimal_mark) {
  std::string plain;
  for (const char c : number.without_blanks) {
    if (c == decimal_mark) {
      plain += '.';
    } else if (c != '.' && c != ',') {
      plain += c;
    }
  }
  return ParseNumber(plain);
}

}  // namespace

std::vector<CsvTable::Record> CsvTable::SplitRecords(std::string_view text) const {
  std::vector<Record> records;
  int line = 1;
  for (size_t at = 0; at < text.size();) {
    Record record;
    record.line = line;
    std::string field;
    bool in_quotes = false;
    const auto end_field = [&] {
      record.fields.emplace_back(TrimBlanks(WithPlainBlanks(field)));
      field.clear();
    };
    for (; at < text.size(); ++at) {
      const char c = text[at];
      const bool ends_line = c == '\n' || c == '\r';
      if (ends_line) {
        if (c == '\r' && text.substr(at, 2) == "\r\n") ++at;
        ++line;
        if (!in_quotes) {
          ++at;
          break;
        }
        field += ' ';
      } else if (c == '"') {
        if (in_quotes && text.substr(at, 2) == "\"\"") {
          field += c;
          ++at;
        } else {
          in_quotes = !in_quotes;
        }
      } else if (c == '%' && !in_quotes &&
                 (field.empty() || field.back() == ' ' || field.back() == '\t')) {
        while (at + 1 < text.size() && text[at + 1] != '\n' && text[at + 1] != '\r') ++at;
      } else if (c == separator_ && !in_quotes) {
        end_field();
      } else {
        field += c;
      }
    }
    end_field();
    record.is_open = in_quotes;
    records.push_back(std::move(record));
  }
  return records;
}

char DecimalMarkOf(const std::vector<std::string>& fields, char separator) {
  size_t num_points = 0;
  size_t num_commas = 0;
  bool has_unclear_comma = false;
  for (const std::string& field : fields) {
    const NumberText number = TakeApart(field);
    if (!number.is_one || number.num_points + number.num_commas != 1) continue;
    if (!number.is_in_thousands) {
      (number.last_mark == '.' ? num_points : num_commas) += 1;
    } else {
      has_unclear_comma = has_unclear_comma || number.last_mark == ',';
    }
  }
  if (num_commas > 0 && num_points > 0) return '?';
  if (num_commas > 0) return ',';
  // "5,123" alone: where columns are not parted by commas, those are decimal.
  if (num_points == 0 && has_unclear_comma) return separator == ',' ? '?' : ',';
  return '.';
}

std::optional<double> CsvTable::Number(std::string_view field, std::string* why_not) const {
  const NumberText number = TakeApart(field);
  if (!number.is_one) return std::nullopt;
  const int num_marks = number.num_points + number.num_commas;
  if (num_marks == 0) return ParseNumber(number.without_blanks);
  if (number.num_points > 0 && number.num_commas > 0) {  // 1.234,5 or 1,234.5
    const int num_decimal = number.last_mark == '.' ? number.num_points : number.num_commas;
    if (num_decimal != 1) return std::nullopt;
    return Parse(number, number.last_mark);
  }
  const char other = number.last_mark == '.' ? ',' : '.';
  if (num_marks > 1) {  // 1.234.567
    if (!number.is_in_thousands) return std::nullopt;
    return Parse(number, other);
  }
  // A point is the decimal mark wherever the table does not use commas for it; a comma where the
  // table does, and where it cannot part thousands.
  const bool is_usual = number.last_mark == '.' ? decimal_mark_ == '.' : decimal_mark_ == ',';
  if (is_usual || !number.is_in_thousands) return Parse(number, number.last_mark);
  if (why_not) {
    *why_not = "may be " + FormatNumber(*Parse(number, number.last_mark)) + " or " +
               FormatNumber(*Parse(number, other)) + "; write it with a decimal point and no comma";
  }
  return std::nullopt;
}

CsvTable::CsvTable(const std::filesystem::path& file, std::vector<std::string>* faults)
    : file_(file) {
  const auto fail = [&](int line, const std::string& message) {
    const Error error(file, line, message);
    if (!faults) throw error;
    faults->push_back(error.what());
  };
  const std::string bytes = ReadFileBytes(file);
  const Utf8Text utf8 = Utf8FromBytes(bytes);
  const std::string why_not = WhyNoTable(file, bytes, utf8.text);
  if (!why_not.empty()) throw Error(file, why_not);
  if (utf8.is_guessed) {
    warnings_.push_back(
        Error(file, "is not UTF-8; it is read as Windows-1252 (Latin-1), look at its names")
            .what());
  }
  std::string_view text = utf8.text;
  // Excel's own way to say it.
  const std::string start = LowerCase(text.substr(0, 6));
  const bool has_word = start.substr(0, 4) == "sep=" && start.size() > 4;
  if (has_word) {
    separator_ = start[4];
  } else {
    // The header has no decimal commas, so what it holds of these parts its columns. A comma
    // inside quotes or a comment does not count.
    separator_ = '\x01';
    for (const Record& record : SplitRecords(text)) {
      if (record.IsEmpty()) continue;
      const std::string& header = record.fields[0];
      separator_ = header.find(';') != std::string::npos    ? ';'
                   : header.find('\t') != std::string::npos ? '\t'
                                                            : ',';
      break;
    }
  }
  std::vector<Record> records = SplitRecords(text);
  if (has_word) records.erase(records.begin());
  std::erase_if(records, [](const Record& record) { return record.IsEmpty(); });
  if (records.empty()) return;

  header_line_ = records[0].line;
  if (records[0].fields.size() == 1 && records[0].fields[0].find(separator_) != std::string::npos) {
    throw Error(file,
                header_line_,
                "this line stands in quotes as a whole, and so is one column; save the table with "
                "its fields in columns of their own, or take the quotes away");
  }
  for (const std::string& name : records[0].fields) header_.push_back(LowerCase(name));
  while (!header_.empty() && header_.back().empty()) header_.pop_back();
  records.erase(records.begin());
  std::vector<std::string> fields;
  for (const Record& record : records) {
    fields.insert(fields.end(), record.fields.begin(), record.fields.end());
  }
  decimal_mark_ = DecimalMarkOf(fields, separator_);
  for (Record& record : records) {
    if (record.is_open) {
      fail(record.line, "a quote here is not closed");
      continue;
    }
    while (record.fields.size() > header_.size() && record.fields.back().empty()) {
      record.fields.pop_back();
    }
    if (record.fields.size() != header_.size()) {
      const std::string fault = "has " + std::to_string(record.fields.size()) +
                                " fields; the header has " + std::to_string(header_.size());
      if (!faults) fail(record.line, fault);
      rows_.push_back({record.line, std::move(record.fields), fault});
      continue;
    }
    rows_.push_back({record.line, std::move(record.fields), ""});
  }
}

std::string CsvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace groundglass
