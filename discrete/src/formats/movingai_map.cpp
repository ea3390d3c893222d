// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <istream>
#include <ostream>
#include <string_view>
#include <utility>

#include "formats/text_input.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/text/sniff.hpp"

namespace quadrille::discrete {
namespace {

enum class Reading : unsigned char { unknown, passable, blocked };
using LetterTable = std::array<Reading, 256>;

std::size_t slot(char letter) { return static_cast<unsigned char>(letter); }

Result<LetterTable> letter_table(const MapOptions& options) {
  LetterTable table;
  table.fill(Reading::unknown);
  const auto fill = [&table](std::string_view letters, Reading reading) {
    for (const char c : letters) table[slot(c)] = reading;
  };
  fill(".G", Reading::passable);
  fill("@OT", Reading::blocked);
  for (const char c : options.passable + options.blocked)
    if (c <= ' ' || c > '~')
      return Error{ErrorCode::out_of_range,
                   in_quotes(std::string_view(&c, 1)) + " cannot be a letter of a map",
                   {}};
  for (const char c : options.passable)
    if (options.blocked.find(c) != std::string::npos)
      return Error{ErrorCode::out_of_range,
                   "the letter " + in_quotes(std::string_view(&c, 1)) +
                       " is named both as passable and as blocked",
                   {}};
  fill(options.passable, Reading::passable);
  fill(options.blocked, Reading::blocked);
  return table;
}

class MapReader {
 public:
  MapReader(std::string_view text, const std::string& file, const LetterTable& table)
      : lines_(text), file_(file), table_(table) {}

  Result<GridMap> run() {
    if (auto error = read_header()) return *error;
    counts_.fill(0);
    for (std::int32_t y = 0; y < map_.height; ++y)
      if (auto error = read_row(y)) return *error;
    while (const auto line = lines_.next())
      if (!line->empty())
        return fail(ErrorCode::syntax, "text after the last row of the map: " + in_quotes(*line));
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const char c = static_cast<char>(i);
      if (counts_[i] > 0 && c != '.' && c != '@' && c != 'T')
        map_.other_letters.push_back({c, table_[i] == Reading::passable, counts_[i]});
    }
    return std::move(map_);
  }

 private:
  Error fail(ErrorCode code, std::string message) const {
    return {code, std::move(message), {file_, lines_.number()}};
  }

  /// The next line of the header; published files have blanks at the ends of these lines.
  void take_line() {
    line_ = lines_.next();
    if (line_) line_ = line_->substr(0, line_->find_last_not_of(" \t") + 1);
  }

  std::optional<Error> expect(std::string_view wanted) const {
    if (!line_)
      return fail(ErrorCode::syntax, "the file ends where " + in_quotes(wanted) + " belongs");
    if (*line_ == wanted) return std::nullopt;
    return fail(ErrorCode::syntax,
                "expected " + in_quotes(wanted) + ", found " + in_quotes(*line_));
  }

  std::optional<Error> read_size(std::string_view name, std::int32_t& size) const {
    const std::string wanted = std::string(name) + " ";
    const auto& line = line_;
    if (!line) return fail(ErrorCode::syntax, "the file ends where the " + wanted + "belongs");
    if (!line->starts_with(wanted))
      return fail(ErrorCode::syntax,
                  "expected " + in_quotes(wanted + "<number>") + ", found " + in_quotes(*line));
    const std::string_view digits = line->substr(wanted.size());
    const Natural number = parse_natural(digits, kMaxMapCells);
    if (number.fault == NumberFault::too_large)
      return fail(ErrorCode::out_of_range,
                  wanted + printable(digits, 40) + " is more than " + std::to_string(kMaxMapCells));
    if (number.fault == NumberFault::malformed || number.value == 0)
      return fail(ErrorCode::syntax,
                  "the " + wanted + "has to be a positive number, not " + in_quotes(digits));
    size = static_cast<std::int32_t>(number.value);
    return std::nullopt;
  }

  std::optional<Error> read_header() {
    take_line();
    // Some published files have no type.
    const bool is_size = line_ && (line_->starts_with("height ") || line_->starts_with("width "));
    if (!is_size) {
      if (auto error = expect("type octile")) return error;
      take_line();
    }
    const bool width_first = line_ && line_->starts_with("width ");
    for (const bool is_width : {width_first, !width_first}) {
      auto error = is_width ? read_size("width", map_.width) : read_size("height", map_.height);
      if (error) return error;
      if (std::int64_t{map_.height} * map_.width > kMaxMapCells)
        return fail(ErrorCode::out_of_range,
                    "a map of " + std::to_string(map_.width) + " x " + std::to_string(map_.height) +
                        " cells is larger than " + std::to_string(kMaxMapCells) + " cells");
      take_line();
    }
    return expect("map");
  }

  // Rows grow the map one by one: a header that promises more than the file has costs nothing.
  std::optional<Error> read_row(std::int32_t y) {
    const auto line = lines_.next();
    if (!line)
      return fail(ErrorCode::syntax, "the file ends after " + std::to_string(y) + " of " +
                                         std::to_string(map_.height) + " rows");
    if (line->size() != static_cast<std::size_t>(map_.width))
      return fail(ErrorCode::syntax, "row " + std::to_string(y) + " has " +
                                         std::to_string(line->size()) + " letters instead of " +
                                         std::to_string(map_.width));
    for (std::size_t x = 0; x < line->size(); ++x) {
      const char c = (*line)[x];
      const Reading reading = table_[slot(c)];
      if (reading == Reading::unknown)
        return fail(ErrorCode::syntax, "column " + std::to_string(x + 1) + ": the letter " +
                                           in_quotes(line->substr(x, 1)) +
                                           " is neither known as passable nor as blocked");
      ++counts_[slot(c)];
      map_.passable.push_back(reading == Reading::passable);
    }
    return std::nullopt;
  }

  LineReader lines_;
  std::optional<std::string_view> line_;  // Of the header.
  const std::string& file_;
  const LetterTable& table_;
  GridMap map_;
  std::array<std::int64_t, 256> counts_{};
};

}  // namespace

std::int64_t GridMap::num_passable() const {
  return std::count(passable.begin(), passable.end(), true);
}

Result<GridMap> read_map(std::istream& in, const std::string& file, const MapOptions& options) {
  const auto table = letter_table(options);
  if (!table) return table.error();
  const auto text = read_all(in, file);
  if (!text) return text.error();
  if (auto error = text::refuse_other(*text, file, {text::FileKind::movingai_map})) return *error;
  return MapReader(*text, file, *table).run();
}

Result<GridMap> read_map(const std::filesystem::path& path, const MapOptions& options) {
  std::ifstream in;
  if (auto error = open_input(path, in)) return *error;
  return read_map(in, path.string(), options);
}

std::optional<Error> write_map(std::ostream& out, const std::string& file, const GridMap& map) {
  out << "type octile\nheight " << map.height << "\nwidth " << map.width << "\nmap\n";
  std::string row;
  for (std::int32_t y = 0; y < map.height && out; ++y) {
    row.clear();
    for (std::int32_t x = 0; x < map.width; ++x) row += map.is_passable({x, y}) ? '.' : '@';
    out << row << '\n';
  }
  return finish_output(out, file);
}

}  // namespace quadrille::discrete
