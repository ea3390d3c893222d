// SPDX-License-Identifier: MIT
#include "read/records.hpp"

#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

namespace quadrille_check {
namespace {

/// What the binary form has room for.
constexpr Int kMostNumber = Int{1} << 62;
constexpr std::string_view kBinary = "qcert 1 bin\n", kText = "qcert 1 text\n";

void append(std::string& text, std::span<const Int> values) {
  for (const Int value : values) text += " " + std::to_string(value);
}

}  // namespace

std::span<const Int> Record::part(std::size_t begin, Int count) const {
  require(begin <= values.size() && count >= 0 &&
              static_cast<std::uint64_t>(count) <= values.size() - begin,
          "the record is too short");
  return std::span(values).subspan(begin, static_cast<std::size_t>(count));
}

std::span<const Int> Record::parameters() const {
  static_cast<void>(part(0, 2));
  return part(2, values[1]);
}
std::span<const Int> Record::literals() const {
  return std::span(values).subspan(2 + parameters().size());
}
std::span<const Int> Record::derived() const {
  static_cast<void>(part(0, 1));
  return part(1, values[0]);
}
std::span<const Int> Record::hints() const {
  return std::span(values).subspan(1 + derived().size());
}

std::string Record::text(Int clause) const {
  std::string text(1, tag);
  if (tag == 'a') {
    text += " " + std::to_string(values.empty() ? 0 : values[0]);
    append(text, parameters());
    text += " |";
    append(text, literals());
  } else if (tag == 'l') {
    append(text, derived());
    text += " 0";
    for (const Int hint : hints()) text += " " + std::to_string(clause - hint);
  } else {
    append(text, values);
  }
  return text;
}

RecordReader::RecordReader(std::string content) : content_(std::move(content)) {
  is_text_ = content_.compare(0, kText.size(), kText) == 0;
  require(is_text_ || content_.compare(0, kBinary.size(), kBinary) == 0,
          "the file is no certificate of this version");
  at_ = is_text_ ? kText.size() : kBinary.size();
}

bool RecordReader::next(Record& record) {
  ++number_;
  if (!(is_text_ ? next_line(record) : next_binary(record))) {
    --number_;
    return false;
  }
  if (record.tag == 'a' || record.tag == 'l') ++num_clauses_;
  return true;
}

std::uint64_t RecordReader::unsigned_number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 63; shift += 7) {
    require(at_ < content_.size(), "the file ends within a record");
    const auto byte = static_cast<unsigned char>(content_[at_++]);
    value |= static_cast<std::uint64_t>(byte & 127) << shift;
    if (byte < 128) return value;
  }
  throw Rejected("a number is too large");
}

bool RecordReader::next_binary(Record& record) {
  if (at_ == content_.size()) return false;
  record.tag = content_[at_++];
  const std::uint64_t count = unsigned_number();
  require(count <= content_.size() - at_, "the file ends within a record");  // a byte each
  record.values.resize(count);
  for (Int& value : record.values) {
    const std::uint64_t folded = unsigned_number();
    value = static_cast<Int>(folded >> 1) ^ -static_cast<Int>(folded & 1);
  }
  return true;
}

bool RecordReader::next_line(Record& record) {
  while (at_ < content_.size()) {
    const std::size_t end = std::min(content_.find('\n', at_), content_.size());
    std::string line = content_.substr(at_, end - at_);
    at_ = std::min(end + 1, content_.size());
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    read_fields(line, record);
    return true;
  }
  return false;
}

void RecordReader::read_fields(const std::string& line, Record& record) const {
  std::istringstream fields(line);
  std::string field;
  fields >> field;
  require(field.size() == 1, "a line begins with a letter");
  record.tag = field[0];
  record.values.clear();
  Int separator = -1;  // where "|" or, of a derived clause, 0 stands
  while (fields >> field) {
    if (field == "|" && record.tag == 'a' && separator < 0) {
      separator = static_cast<Int>(record.values.size());
      continue;
    }
    Int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    require(error == std::errc() && end == field.data() + field.size() && value > -kMostNumber &&
                value < kMostNumber,
            "a field is no number");
    if (value == 0 && record.tag == 'l' && separator < 0) {
      separator = static_cast<Int>(record.values.size());
      continue;
    }
    record.values.push_back(record.tag == 'l' && separator >= 0 ? num_clauses_ + 1 - value : value);
  }
  if (record.tag == 'a') {
    require(separator >= 1, "an axiom has a rule, and | before its literals");
    record.values.insert(record.values.begin() + 1, separator - 1);
  }
  if (record.tag == 'l') {
    require(separator >= 0, "a derived clause has a 0 after its literals");
    record.values.insert(record.values.begin(), separator);
  }
}

}  // namespace quadrille_check
