// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "session/tags_table.h"

#include "scene/error.h"
#include "scene/formats/csv.h"
#include "scene/formats/image_kind.h"
#include "scene/formats/text_encoding.h"
#include "scene/frames.h"
#include "scene/text.h"
#include "session/reason_note.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace groundglass {
namespace {

bool IsBlankChar(char c) { return c == ' ' || c == '\t'; }

// The table as UTF-16 has a mark, or a zero in every other byte.
bool IsUtf16(const std::string& bytes) {
  return bytes.compare(0, 2, "\xFF\xFE") == 0 || bytes.compare(0, 2, "\xFE\xFF") == 0 ||
         bytes.find('\0') != std::string::npos;
}

// As the header says it: the first of these that is in it, or what "sep=" names.
char FindSeparator(const std::string& bytes) {
  const size_t start = bytes.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
  if (LowerCase(bytes.substr(start, 4)) == "sep=" && bytes.size() > start + 4) {
    return bytes[start + 4];
  }
  // The first line that is neither empty nor a comment is the header.
  std::string words;
  for (size_t at = start; at < bytes.size() && words.empty();) {
    const size_t end = std::min(bytes.find_first_of("\r\n", at), bytes.size());
    words = TrimBlanks(std::string_view(bytes).substr(at, end - at));
    if (!words.empty() && words[0] == '%') words.clear();
    at = end + 1;
  }
  if (words.find(';') != std::string::npos) return ';';
  return words.find('\t') != std::string::npos ? '\t' : ',';
}

// Whether a field says a number already; angles are made of a look-at point, and round.
bool IsSaid(const std::string& column, double said, double value) {
  const bool is_angle = column == "yaw" || column == "pitch";
  return said == value || (is_angle && std::abs(said - value) < 1e-9);
}

std::string Unquoted(std::string field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return field;
  field = field.substr(1, field.size() - 2);
  for (size_t at = field.find("\"\""); at != std::string::npos; at = field.find("\"\"", at + 1)) {
    field.erase(at, 1);
  }
  return std::string(TrimBlanks(field));
}

}  // namespace

TagsTable::TagsTable(const std::filesystem::path& file, const std::string& bytes)
    : file_(file), bytes_(bytes) {
  if (IsUtf16(bytes_)) {
    throw Error(file_, "is UTF-16; save it as UTF-8 for tags to be saved into it from here");
  }
  if (!IsUtf8(bytes_)) {
    throw Error(file_, "is not UTF-8; save it as UTF-8 for tags to be saved into it from here");
  }
  separator_ = FindSeparator(bytes_);
  line_break_ = bytes_.find("\r\n") != std::string::npos ? "\r\n"
                : bytes_.find('\n') == std::string::npos && bytes_.find('\r') != std::string::npos
                    ? "\r"
                    : "\n";
  records_ = Split(bytes_);
  const auto is_header = [&](const Record& record) {
    for (size_t i = 0; i < record.fields.size(); ++i) {
      if (LowerCase(Field(record, i)) == "image") return true;
    }
    return false;
  };
  const auto header = std::find_if(records_.begin(), records_.end(), is_header);
  if (header == records_.end()) throw Error(file_, "no header; expected image,x,y,z,i,j,k,a,v");
  for (size_t i = 0; i < header->fields.size(); ++i)
    header_.push_back(LowerCase(Field(*header, i)));
  records_.erase(records_.begin(), header + 1);
  std::vector<std::string> fields;
  for (const Record& record : records_) {
    for (size_t i = 0; i < record.fields.size(); ++i) fields.push_back(Field(record, i));
  }
  decimal_mark_ = DecimalMarkOf(fields, separator_);
}

std::vector<TagsTable::Record> TagsTable::Split(const std::string& text) const {
  std::vector<Record> records;
  size_t at = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
  while (at < text.size()) {
    Record record;
    record.text.begin = at;
    size_t field_begin = at;
    bool in_quotes = false;
    const auto end_field = [&](size_t end) {
      Span field = {field_begin, end};
      // From its end, so that an empty field is where it begins, before its blanks.
      while (field.end > field.begin && IsBlankChar(text[field.end - 1])) --field.end;
      while (field.begin < field.end && IsBlankChar(text[field.begin])) ++field.begin;
      record.fields.push_back(field);
      field_begin = end + 1;
    };
    bool is_comment = false;
    for (; at < text.size(); ++at) {
      const char c = text[at];
      if ((c == '\n' || c == '\r') && !in_quotes) break;
      if (is_comment) continue;
      if (c == '"') in_quotes = !in_quotes;
      const bool may_comment = at == field_begin || IsBlankChar(text[at - 1]);
      if (c == '%' && !in_quotes && may_comment) {
        is_comment = true;
        record.comment = at;
      } else if (c == separator_ && !in_quotes) {
        end_field(at);
      }
    }
    record.text.end = at;
    if (!is_comment) record.comment = at;
    end_field(record.comment);
    if (text.compare(at, 2, "\r\n") == 0) ++at;
    record.next = at = std::min(at + 1, text.size());
    records.push_back(std::move(record));
  }
  return records;
}

std::string TagsTable::Field(const Record& record, size_t column) const {
  if (column >= record.fields.size()) return "";
  const Span& span = record.fields[column];
  return Unquoted(bytes_.substr(span.begin, span.end - span.begin));
}

const TagsTable::Record* TagsTable::Find(const std::string& photograph) const {
  const auto image = std::find(header_.begin(), header_.end(), "image");
  const size_t column = static_cast<size_t>(image - header_.begin());
  for (const Record& record : records_) {
    const std::string field = Field(record, column);
    if (!field.empty() && FoldedName(ImageStem(field)) == FoldedName(photograph)) return &record;
  }
  return nullptr;
}

std::optional<std::string> TagsTable::Row(const std::string& photograph) const {
  const Record* record = Find(photograph);
  if (record == nullptr) return std::nullopt;
  return bytes_.substr(record->text.begin, record->text.end - record->text.begin);
}

std::string TagsTable::With(const std::string& photograph,
                            const std::optional<std::string>& row) const {
  std::string text = bytes_;
  if (const Record* record = Find(photograph)) {
    if (row) return text.replace(record->text.begin, record->text.end - record->text.begin, *row);
    return text.erase(record->text.begin, record->next - record->text.begin);
  }
  if (!row) return text;
  const bool is_ended = text.empty() || text.back() == '\n' || text.back() == '\r';
  return text + (is_ended ? "" : line_break_) + *row + line_break_;
}

std::string TagsTable::ReasonOf(const std::string& row) {
  const size_t at = row.find(kReasonMark);
  if (at == std::string::npos) return "";
  return std::string(TrimBlanks(std::string_view(row).substr(at + kReasonMark.size())));
}

std::optional<double> TagsTable::NumberIn(const std::string& field) const {
  std::string plain = field;
  if (decimal_mark_ == ',') std::replace(plain.begin(), plain.end(), ',', '.');
  return ParseNumber(plain);
}

std::string TagsTable::Number(double value) const {
  std::string text = FormatNumber(value);
  if (decimal_mark_ == ',') std::replace(text.begin(), text.end(), '.', ',');
  return separator_ == ',' && decimal_mark_ == ',' ? '"' + text + '"' : text;
}

// Quoted where it would be taken apart, or for a comment.
std::string TagsTable::NameField(const std::string& photograph) const {
  const std::string apart = std::string("\"%") + separator_;
  if (photograph.find_first_of(apart) == std::string::npos) return photograph;
  std::string quoted = "\"";
  for (const char c : photograph) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

// What each column of a tag has to say, by its name.
std::map<std::string, double> TagsTable::ValuesOf(const ViewTag& tag) const {
  const auto has = [&](const char* name) {
    return std::find(header_.begin(), header_.end(), name) != header_.end();
  };
  if (has("lat")) {
    throw Error(file_,
                "has places as lat,lon,height; `convert` it to views/ to save tags from here");
  }
  std::map<std::string, double> values;
  for (int key = 0; key < kNumTagKeys; ++key) {
    values[std::string(kTagKeyNames[key])] = GetTagValue(tag, static_cast<TagKey>(key));
  }
  if (has("yaw")) {
    const Eigen::Vector3d axis = (tag.lookat_in_site - tag.position_in_site).normalized();
    values["yaw"] = DegreesFromRadians(std::atan2(axis.x(), axis.y()));
    values["pitch"] = DegreesFromRadians(std::asin(std::clamp(axis.z(), -1.0, 1.0)));
    for (const char* key : {"i", "j", "k"}) values.erase(key);
  }
  for (const SigmaKey& key : kSigmaKeys) {
    if (const auto& sigma = tag.sigmas.*key.member) values[std::string(key.name)] = *sigma;
  }
  return values;
}

std::string TagsTable::SigmasWithoutColumn(const ViewTag& tag) const {
  std::string names;
  for (const SigmaKey& key : kSigmaKeys) {
    const bool has_column =
        std::find(header_.begin(), header_.end(), std::string(key.name)) != header_.end();
    if (tag.sigmas.*key.member && !has_column) {
      names += (names.empty() ? "" : ",") + std::string(key.name);
    }
  }
  return names;
}

std::string TagsTable::FormatRow(const std::string& photograph,
                                 const ViewTag& tag,
                                 const std::string& reason) const {
  if (decimal_mark_ == '?') {
    throw Error(file_, "has numbers with decimal points and with commas; write them in one way");
  }
  const std::map<std::string, double> values = ValuesOf(tag);
  std::string missing;
  for (const auto& [name, value] : values) {
    const bool is_sigma = name.compare(0, 6, "sigma_") == 0;
    const bool has_column = std::find(header_.begin(), header_.end(), name) != header_.end();
    if (!is_sigma && !has_column && value != 0) missing += (missing.empty() ? "" : ",") + name;
  }
  if (!missing.empty()) {
    throw Error(file_,
                "has no column " + missing + "; add it to the header, empty fields to other rows");
  }
  const Record* record = Find(photograph);
  std::string row;
  for (size_t column = 0; column < header_.size(); ++column) {
    const auto value = values.find(header_[column]);
    std::string field = record ? Field(*record, column) : "";
    if (header_[column] == "image" && record == nullptr) field = NameField(photograph);
    const auto said = NumberIn(field);
    const bool is_changed =
        value != values.end() &&
        (said ? !IsSaid(header_[column], *said, value->second) : value->second != 0);
    // What stands around a field, and a field that says the same, stays to the byte.
    const size_t from = !record       ? 0
                        : column == 0 ? record->text.begin
                                      : record->fields[column - 1].end;
    const bool is_there = record != nullptr && column < record->fields.size();
    if (is_there) {
      row += bytes_.substr(from, record->fields[column].begin - from);
      const Span& span = record->fields[column];
      field = bytes_.substr(span.begin, span.end - span.begin);
    } else if (column > 0) {
      row += separator_;
    }
    row += is_changed ? Number(value->second) : field;
  }
  std::string rest;
  if (record != nullptr && !record->fields.empty()) {
    const size_t end = record->fields[std::min(header_.size(), record->fields.size()) - 1].end;
    rest = bytes_.substr(end, record->text.end - end);
  }
  // A number is not to touch a comment: it would be none any more.
  if (!rest.empty() && rest[0] == '%' && !row.empty() && !IsBlankChar(row.back()) &&
      row.back() != separator_) {
    row += ' ';
  }
  const size_t old_reason = rest.find(kReasonMark);
  if (old_reason != std::string::npos) rest.erase(old_reason);
  while (old_reason != std::string::npos && !rest.empty() && IsBlankChar(rest.back())) {
    rest.pop_back();
  }
  std::string note = reason;
  std::replace_if(
      note.begin(), note.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return row + rest + (note.empty() ? "" : " " + std::string(kReasonMark) + note);
}

}  // namespace groundglass
