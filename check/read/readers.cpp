// SPDX-License-Identifier: MIT
// MovingAI maps and scenarios, and instances in JSON: docs/formats.md, docs/formats-of-others.md.
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>

#include "read/instance.hpp"
#include "read/json.hpp"

namespace quadrille_check {
namespace {

constexpr Int kMaxCells = Int{1} << 26, kMaxVertices = Int{1} << 23;

Int number(std::string_view text, Int most, const std::string& what) {
  Int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most)
    throw BadInput(what + " is no number that is possible");
  return value;
}

/// The lines of a file without their ends.
class Lines {
 public:
  explicit Lines(const std::string& file) : file_(file), in_(read_file(file)) {}
  bool next(std::string& line) {
    if (!std::getline(in_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    ++number_;
    return true;
  }
  [[nodiscard]] std::string expect(const std::string& start) {
    std::string line;
    if (!next(line) || line.compare(0, start.size(), start) != 0)
      fail("expected \"" + start + "\"");
    return line.substr(start.size());
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(file_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  const std::string file_;
  std::istringstream in_;
  int number_ = 0;
};

/// 1: passable, 0: blocked, -1: unknown.
std::array<int, 256> letter_table(const std::string& passable, const std::string& blocked) {
  std::array<int, 256> table{};
  table.fill(-1);
  const auto fill = [&table](std::string_view letters, int value) {
    for (const char c : letters) table[static_cast<unsigned char>(c)] = value;
  };
  fill(".G", 1);
  fill("@OT", 0);
  for (const char c : passable)
    if (blocked.find(c) != std::string::npos) throw BadInput("a letter is passable and blocked");
  fill(passable, 1);
  fill(blocked, 0);
  return table;
}

Instance read_map(const std::string& file, const std::array<int, 256>& letters) {
  Lines lines(file);
  if (!lines.expect("type octile").empty()) lines.fail("another type than octile");
  const Int height = number(lines.expect("height "), kMaxCells, file + ": height");
  const Int width = number(lines.expect("width "), kMaxCells, file + ": width");
  if (height == 0 || width == 0 || height * width > kMaxCells) lines.fail("no such size");
  if (!lines.expect("map").empty()) lines.fail("expected \"map\"");
  std::vector<bool> passable;
  std::string row;
  for (Int y = 0; y < height; ++y) {
    if (!lines.next(row) || static_cast<Int>(row.size()) != width) lines.fail("a row is missing");
    for (const char c : row) {
      const int value = letters[static_cast<unsigned char>(c)];
      if (value < 0) lines.fail("a letter that is neither passable nor blocked");
      passable.push_back(value == 1);
    }
  }
  while (lines.next(row))
    if (!row.empty()) lines.fail("text after the map");
  return Instance::on_grid(static_cast<int>(width), static_cast<int>(height), passable);
}

int cell(const Instance& instance, Int x, Int y) {
  if (x < 0 || y < 0 || x >= instance.width() || y >= instance.height())
    throw BadInput("a place outside of the map");
  return static_cast<int>(y * instance.width() + x);
}

}  // namespace

std::string read_file(const std::string& name) {
  std::ifstream in(name, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || in.bad()) throw BadInput(name + ": cannot be read");
  return text.str();
}

Instance read_movingai(const std::string& map, const std::string& scen, int num_agents,
                       const std::string& passable, const std::string& blocked) {
  Instance instance = read_map(map, letter_table(passable, blocked));
  Lines lines(scen);
  const std::string version = lines.expect("version ");
  if (version != "1" && version != "1.0") lines.fail("another version than 1");
  std::string line;
  for (int agent = 0; agent < num_agents; ++agent) {
    if (!lines.next(line)) lines.fail("fewer rows than agents");
    std::istringstream fields(line);
    std::array<std::string, 9> field;
    std::string more;
    for (std::string& text : field)
      if (!(fields >> text)) lines.fail("a row with fewer than nine fields");
    if (fields >> more) lines.fail("a row with more than nine fields");
    std::array<Int, 6> value{};
    for (std::size_t k = 0; k < value.size(); ++k)
      value[k] = number(field[k + 2], kMaxCells, scen + ": a field");
    if (value[0] != instance.width() || value[1] != instance.height())
      lines.fail("a row for a map of another size");
    instance.add_agent({cell(instance, value[2], value[3]), cell(instance, value[4], value[5])});
  }
  return instance;
}

namespace {

Instance graph_of(const Json& root) {
  if (const Json* grid = root.find("grid")) {
    grid->only({"width", "height", "rows"});
    const Int width = grid->at("width").number(1, kMaxCells);
    const Int height = grid->at("height").number(1, kMaxCells);
    const auto rows = grid->at("rows").list();
    bool fits = width * height <= kMaxCells && static_cast<Int>(rows.size()) == height;
    std::vector<bool> passable;
    for (const Json* row : rows) {
      fits = fits && static_cast<Int>(row->text().size()) == width &&
             row->text().find_first_not_of(".@") == std::string::npos;
      for (const char c : row->text()) passable.push_back(c == '.');
    }
    if (!fits) throw BadInput("the rows are not as many and as long as is said, of . and @");
    return Instance::on_grid(static_cast<int>(width), static_cast<int>(height), passable);
  }
  const Json& graph = root.at("graph");
  graph.only({"vertices", "edges", "directed"});
  if (const Json* directed = graph.find("directed"); directed != nullptr && directed->is_true())
    throw BadInput("there is no rule for directed graphs");
  const Int size = graph.at("vertices").number(0, kMaxVertices);
  std::vector<std::pair<int, int>> edges;
  for (const Json* edge : graph.at("edges").list()) {
    const auto ends = edge->list();
    if (ends.size() != 2) throw BadInput("an edge has two ends");
    edges.emplace_back(static_cast<int>(ends[0]->number(0, size)),
                       static_cast<int>(ends[1]->number(0, size)));
  }
  return Instance::on_graph(static_cast<int>(size), std::move(edges));
}

int place_of(const Instance& instance, const Json& json) {
  if (!instance.is_grid()) return static_cast<int>(json.number(0, kMaxVertices));
  const auto both = json.list();
  if (both.size() != 2) throw BadInput("a cell has two coordinates");
  return cell(instance, both[0]->number(0, kMaxCells), both[1]->number(0, kMaxCells));
}

}  // namespace

Instance read_json(const std::string& file) { return instance_of(read_json_file(file), file); }

Json read_json_file(const std::string& file) {
  const std::string text = read_file(file);
  try {
    return parse_json(text);
  } catch (const BadInput& error) {
    throw BadInput(file + ": " + error.what());
  }
}

Instance instance_of(const Json& root, const std::string& file) {
  try {
    root.only({"quadrille", "version", "now", "grid", "graph", "agents"});
    // Costs and the times of certificates count from there.
    if (const Json* now = root.find("now")) static_cast<void>(now->number(0, 1'000'000'000));
    if (root.at("quadrille").text() != "instance" || root.at("version").number(1, 1) != 1 ||
        (root.find("grid") != nullptr && root.find("graph") != nullptr))
      throw BadInput("no instance of version 1, on a grid or on a graph");
    Instance instance = graph_of(root);
    for (const Json* agent : root.at("agents").list()) {
      // An agent with several goals, say, is none of those that this program knows.
      agent->only({"start", "goal", "name"});
      instance.add_agent(
          {place_of(instance, agent->at("start")), place_of(instance, agent->at("goal"))});
    }
    return instance;
  } catch (const BadInput& error) {
    throw BadInput(file + ": " + error.what());
  }
}

}  // namespace quadrille_check
