// SPDX-License-Identifier: MIT
#include "support/case_text.hpp"

#include <array>
#include <sstream>
#include <utility>

namespace quadrille::discrete::support {
namespace {

std::vector<std::string> map_rows(const GridLayout& layout) {
  std::vector<std::string> rows;
  for (std::int32_t y = 0; y < layout.height(); ++y) {
    rows.emplace_back();
    for (std::int32_t x = 0; x < layout.width(); ++x)
      rows.back() += layout.vertex_at({x, y}) ? '.' : '@';
  }
  return rows;
}

/// Small letters for the starts, capitals for the goals, side by side.
std::string picture(const Instance& instance) {
  const GridLayout& layout = *instance.graph().layout();
  auto starts = map_rows(layout), goals = starts;
  for (const AgentId i : instance.agent_ids()) {
    const Cell from = layout.cell_of(instance.agents()[i].start);
    const auto letter = static_cast<char>(i.index() % 26);
    starts[static_cast<std::size_t>(from.y)][static_cast<std::size_t>(from.x)] =
        static_cast<char>('a' + letter);
    for (const VertexId goal : instance.agents()[i].goals.vertices()) {
      const Cell to = layout.cell_of(goal);
      goals[static_cast<std::size_t>(to.y)][static_cast<std::size_t>(to.x)] =
          static_cast<char>('A' + letter);
    }
  }
  std::string text;
  for (std::size_t y = 0; y < starts.size(); ++y)
    text += "# " + starts[y] + "   " + goals[y] + "\n";
  return text;
}

std::string place(const Graph& graph, VertexId vertex) {
  if (!graph.layout()) return std::to_string(vertex.value());
  const Cell cell = graph.layout()->cell_of(vertex);
  return std::to_string(cell.x) + " " + std::to_string(cell.y);
}

/// Reads a case line by line; stops at the first error.
class CaseReader {
 public:
  explicit CaseReader(std::string file) : file_(std::move(file)) {}

  Result<Case> read(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    while (!error_ && std::getline(lines, line)) {
      ++line_;
      if (in_map_ && !line.empty() && line.find_first_not_of(".@") == std::string::npos)
        rows_.push_back(line);
      else if (!line.empty() && line[0] != '#')
        read_entry(line);
    }
    if (!error_) finish();
    if (error_) return *error_;
    return std::move(*result_);
  }

 private:
  void fail(std::string message, ErrorCode code = ErrorCode::syntax) {
    if (!error_) error_ = Error{code, std::move(message), {file_, line_}};
  }

  void read_entry(const std::string& line) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    in_map_ = word == "map";
    if (word == "map") {
      grid_ = true;
    } else if (word == "vertices") {
      words >> num_vertices_;
    } else if (word == "edge") {
      std::size_t a = 0, b = 0;
      words >> a >> b;
      edges_.emplace_back(VertexId(a), VertexId(b));
    } else if (word == "task") {
      read_task(words);
    } else if (word == "expect") {
      read_expectation(words);
    } else if (word == "options") {
      options_ = TunedOptions();
      while (!error_ && words >> word) read_option(word);
      return;
    } else {
      fail("unknown entry '" + word + "'");
    }
    if (words.fail()) fail("numbers expected after '" + word + "'");
    if (words >> word) fail("unexpected '" + word + "'");
  }

  void read_task(std::istringstream& words) {
    const auto read_cell = [&] {
      Cell cell{0, 0};
      words >> cell.x;
      if (grid_) words >> cell.y;
      return cell;
    };
    std::string arrow;
    const Cell start = read_cell();
    words >> arrow;
    if (arrow != "->") return fail("expected 'task start -> goal'");
    places_.push_back({start, {read_cell()}});
    for (std::string word; words >> word;) {
      if (word != "or") return fail("unexpected '" + word + "'");
      places_.back().second.push_back(read_cell());
      if (words.fail()) return;
    }
    if (words.eof()) words.clear(std::ios::eofbit);  // all that there is was read
  }

  void read_expectation(std::istringstream& words) {
    std::string word;
    words >> word;
    Cost cost = 0;
    if (word == "infeasible") {
      infeasible_ = true;
    } else if (word == "sum-of-costs" && words >> cost) {
      sum_of_costs_ = cost;
    } else if (word == "makespan" && words >> cost) {
      makespan_ = cost;
    } else {
      fail("expected 'infeasible', 'sum-of-costs N' or 'makespan N'");
    }
  }

  void read_option(const std::string& word) {
    const auto equals = word.find('=');
    const std::string key = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (word == "no-first-plan") {
      options_->first_plan = false;
    } else if (word == "forbid-first") {
      options_->lazy.forbid_first = true;
    } else if (word == "chronological" || word == "not-chronological") {
      options_->lazy.chronological = word == "chronological";
    } else if (word == "open" || word == "not-open") {
      options_->open = word == "open";
    } else if (word == "race") {
      options_->race = true;
    } else if (key == "threads" && value.size() == 1 && value[0] >= '1' && value[0] <= '9') {
      options_->threads = static_cast<std::size_t>(value[0] - '0');
    } else if (word == "audit") {
      options_->debug.audit = true;
    } else if (word == "known-plan") {
      known_plan_ = true;
    } else if (word == "initial-plan") {
      initial_plan_ = true;
    } else if (word == "objective=sum-of-costs") {
      options_->objective = Objective::sum_of_costs;
    } else if (word == "objective=makespan") {
      options_->objective = Objective::makespan;
    } else if (key == "system" && parse_system(value)) {
      options_->system = *parse_system(value);
    } else if (key == "check" && parse_check_schedule(value)) {
      options_->mdd.check = *parse_check_schedule(value);
    } else if (key == "search" && parse_cost_search(value)) {
      options_->cost_search = parse_cost_search(value);
    } else if (key == "growth" && parse_mdd_growth(value)) {
      options_->mdd.growth = *parse_mdd_growth(value);
    } else if (key == "seed" && !value.empty() &&
               value.find_first_not_of("0123456789") == std::string::npos) {
      options_->seed = static_cast<std::uint32_t>(std::stoul(value));
    } else if (key == "first-turn" && !value.empty() && value.size() < 10 &&
               value.find_first_not_of("0123456789") == std::string::npos) {
      options_->first_turn = std::stol(value);
    } else if (key == "first-explicit" && !value.empty() && value.size() < 10 &&
               value.find_first_not_of("0123456789") == std::string::npos) {
      options_->first_explicit = std::stol(value);
    } else if (key == "round" && !value.empty() && value.size() < 10 &&
               value.find_first_not_of("0123456789") == std::string::npos && std::stol(value) > 0) {
      options_->round = std::stol(value);
    } else {
      fail("unknown option '" + word + "'");
    }
  }

  void finish() {
    if (grid_ == (num_vertices_ > 0)) return fail("either a map or vertices expected");
    const std::optional<Graph> graph = grid_ ? make_grid() : make_graph();
    if (!graph) return;
    std::vector<Agent> tasks;
    for (const auto& [start, ends] : places_) {
      const auto from = vertex(*graph, start);
      std::vector<VertexId> goals;
      for (const Cell end : ends)
        if (const auto to = vertex(*graph, end)) goals.push_back(*to);
      if (!from || goals.size() != ends.size())
        return fail("a task names a place that is no vertex");
      tasks.push_back({*from, Goals(std::move(goals))});
    }
    auto instance = Instance::make(*graph, std::move(tasks));
    if (!instance) return fail(instance.error().message, instance.error().code);
    result_ = Case{std::move(instance).value(),
                   sum_of_costs_,
                   makespan_,
                   infeasible_,
                   options_,
                   known_plan_,
                   initial_plan_};
  }

  std::optional<Graph> make_grid() {
    std::vector<bool> passable;
    for (const std::string& row : rows_) {
      if (row.size() != rows_[0].size()) {
        fail("map rows of different lengths");
        return std::nullopt;
      }
      for (const char cell : row) passable.push_back(cell == '.');
    }
    const std::size_t width = rows_.empty() ? 0 : rows_[0].size();
    return Graph::grid(static_cast<std::int32_t>(width), static_cast<std::int32_t>(rows_.size()),
                       passable);
  }

  std::optional<Graph> make_graph() {
    auto graph = Graph::make(num_vertices_, edges_);
    if (graph) return std::move(graph).value();
    fail(graph.error().message, graph.error().code);
    return std::nullopt;
  }

  /// Graphs have their vertices in x.
  static std::optional<VertexId> vertex(const Graph& graph, Cell cell) {
    if (graph.layout()) return graph.layout()->vertex_at(cell);
    if (cell.x < 0 || static_cast<std::size_t>(cell.x) >= graph.num_vertices()) return std::nullopt;
    return VertexId(static_cast<std::size_t>(cell.x));
  }

  std::string file_;
  long line_ = 0;
  std::optional<Error> error_;
  bool in_map_ = false, grid_ = false;
  std::vector<std::string> rows_;
  std::size_t num_vertices_ = 0;
  std::vector<Graph::Edge> edges_;
  std::vector<std::pair<Cell, std::vector<Cell>>> places_;  // starts and goals
  std::optional<Cost> sum_of_costs_, makespan_;
  bool infeasible_ = false, known_plan_ = false, initial_plan_ = false;
  std::optional<TunedOptions> options_;
  std::optional<Case> result_;
};

}  // namespace

std::string instance_text(const Instance& instance) {
  const Graph& graph = instance.graph();
  std::string text;
  if (graph.layout()) {
    text += picture(instance) + "map\n";
    for (const std::string& row : map_rows(*graph.layout())) text += row + "\n";
  } else {
    text += "vertices " + std::to_string(graph.num_vertices()) + "\n";
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
      for (const VertexId w : graph.neighbours(v))
        if (v < w) text += "edge " + place(graph, v) + " " + place(graph, w) + "\n";
  }
  for (const Agent& task : instance.agents()) {
    text += "task " + place(graph, task.start);
    const char* join = " -> ";
    for (const VertexId goal : task.goals.vertices())
      text += std::exchange(join, " or ") + place(graph, goal);
    text += "\n";
  }
  return text;
}

std::string options_text(const TunedOptions& options) {
  std::string text = "options objective=" + std::string(to_string(options.objective)) +
                     " system=" + std::string(to_string(options.system));
  if (options.system == System::dpll || options.system == System::dpll_mdd)
    text += " check=" + to_string(options.mdd.check);
  if (options.cost_search) text += " search=" + std::string(to_string(*options.cost_search));
  if (options.mdd.growth != TunedOptions().mdd.growth)
    text += " growth=" + std::string(to_string(options.mdd.growth));
  text += " seed=" + std::to_string(options.seed);
  if (options.threads > 1) text += " threads=" + std::to_string(options.threads);
  if (options.race) text += " race";
  if (options.lazy.forbid_first) text += " forbid-first";
  if (options.lazy.chronological)
    text += *options.lazy.chronological ? " chronological" : " not-chronological";
  if (options.round) text += " round=" + std::to_string(*options.round);
  if (options.first_turn) text += " first-turn=" + std::to_string(*options.first_turn);
  if (options.first_explicit) text += " first-explicit=" + std::to_string(*options.first_explicit);
  if (options.open) text += *options.open ? " open" : " not-open";
  if (!options.first_plan) text += " no-first-plan";
  if (options.debug.audit) text += " audit";
  if (options.debug.known_plan) text += " known-plan";
  if (options.initial_plan) text += " initial-plan";
  return text + "\n";
}

Result<Case> parse_case(const std::string& text, const std::string& file) {
  return CaseReader(file).read(text);
}

}  // namespace quadrille::discrete::support
