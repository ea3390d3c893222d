// SPDX-License-Identifier: MIT
#include "check/support.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace quadrille_check::support {

namespace discrete = quadrille::discrete;
using quadrille::AgentId;
using quadrille::VertexId;
using quadrille::support::Random;

std::vector<int> places(const discrete::Instance& instance, const discrete::Path& path) {
  std::vector<int> places;
  const auto& layout = instance.graph().layout();
  for (const VertexId v : path)
    places.push_back(layout ? layout->cell_of(v).y * layout->width() + layout->cell_of(v).x
                            : static_cast<int>(v.index()));
  return places;
}

Instance checked(const discrete::Instance& instance) {
  const discrete::Graph& graph = instance.graph();
  const auto make = [&] {
    if (const auto& layout = graph.layout()) {
      std::vector<bool> passable;
      for (int y = 0; y < layout->height(); ++y)
        for (int x = 0; x < layout->width(); ++x)
          passable.push_back(layout->vertex_at({x, y}).has_value());
      return Instance::on_grid(layout->width(), layout->height(), passable);
    }
    std::vector<std::pair<int, int>> edges;
    for (const VertexId v : quadrille::IdRange<VertexId>(graph.num_vertices()))
      for (const VertexId w : graph.neighbours(v))
        if (v < w) edges.emplace_back(static_cast<int>(v.index()), static_cast<int>(w.index()));
    return Instance::on_graph(static_cast<int>(graph.num_vertices()), edges);
  };
  Instance made = make();
  for (const AgentId i : instance.agent_ids()) {
    const auto ends = places(instance, {instance.agents()[i].start, instance.agents()[i].goal()});
    made.add_agent({ends[0], ends[1]});
  }
  return made;
}

Instance grid(const std::string& rows, const std::vector<Instance::Agent>& agents) {
  std::vector<bool> passable;
  std::istringstream in(rows);
  int width = 0, height = 0;
  for (std::string row; std::getline(in, row, '/'); ++height) {
    width = static_cast<int>(row.size());
    for (const char c : row) passable.push_back(c == '.');
  }
  Instance made = Instance::on_grid(width, height, passable);
  for (const auto& agent : agents) made.add_agent(agent);
  return made;
}

std::string rejection(const Instance& instance, const std::string& lines) {
  const std::string head = "qcert 1 text\ni " + std::to_string(instance.agents().size()) + " 0\n";
  try {
    Checker checker(instance);
    RecordReader reader(head + lines);
    for (Record record; reader.next(record);) checker.check(record);
    return "";
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
}
Answer ask(const Instance& instance, const std::string& certificate) {
  try {
    Checker checker(instance);
    RecordReader reader(certificate);
    for (Record record; reader.next(record);) checker.check(record);
    return {true, checker.verdict(), ""};
  } catch (const Rejected& rejected) {
    return {false, {}, rejected.what()};
  }
}

std::vector<Record> records_of(const std::string& certificate) {
  std::vector<Record> records;
  RecordReader reader(certificate);
  for (Record record; reader.next(record);) records.push_back(record);
  return records;
}

std::string text_of(const std::vector<Record>& records) {
  std::string text = "qcert 1 text\n";
  Int clause = 0;
  for (const Record& record : records) {
    if (record.tag == 'a' || record.tag == 'l') ++clause;
    text += record.text(clause) + "\n";
  }
  return text;
}

int Interpretation::where(int agent, int time) const {
  const auto& path = paths_[static_cast<std::size_t>(agent)];
  return path[std::min(static_cast<std::size_t>(time), path.size() - 1)];
}

Int Interpretation::cost(int agent) const {
  const auto& path = paths_[static_cast<std::size_t>(agent)];
  std::size_t arrival = path.size() - 1;
  while (arrival > 0 && path[arrival - 1] == path.back()) --arrival;
  return static_cast<Int>(arrival);
}

bool Interpretation::does(const Variable& usage) const {
  if (usage.is_edge) {
    const int from = where(usage.agent, usage.time), to = where(usage.agent, usage.time + 1);
    return std::minmax(from, to) == std::minmax(usage.from, usage.to);
  }
  const auto end = static_cast<int>(paths_[static_cast<std::size_t>(usage.agent)].size());
  return std::any_of(usage.visits.begin(), usage.visits.end(), [&](const Visit& visit) {
    // After its end the path stays where it is.
    for (int t = visit.first; t <= visit.last && t <= std::max(visit.first, end); ++t)
      if (where(usage.agent, t) == visit.place) return true;
    return false;
  });
}

bool Interpretation::is_true(Int lit) const {
  const Variable& x = meanings_.variable(lit);
  bool holds = false;
  switch (x.kind) {
    case Variable::Kind::does_not:
      holds = !does(x);
      break;
    case Variable::Kind::costs_at_most:
      holds = cost(x.agent) <= x.number;
      break;
    case Variable::Kind::is_there:
      holds = where(x.agent, x.visits[0].first) == x.visits[0].place;
      break;
    case Variable::Kind::number_is_at_least:
      holds = value(x.node) >= x.number;
      break;
  }
  return holds == (lit > 0);
}

Int Interpretation::value(Int number) const {
  const Node& n = meanings_.node(number);
  switch (n.kind) {
    case Node::Kind::literal:
      return is_true(n.of) ? 1 : 0;
    case Node::Kind::agent:
      return std::max<Int>(0, cost(static_cast<int>(n.of)) - n.base);
    case Node::Kind::beyond:
      return std::max<Int>(0, value(n.of) - n.base);
    case Node::Kind::sum:
      return value(n.of) + value(n.base);
    case Node::Kind::levels:
      break;
  }
  const auto reaches = [&](Int level) { return value(level) >= n.rank; };
  const auto count = std::count_if(n.levels.begin(), n.levels.end(), reaches);
  return std::max<Int>(0, static_cast<Int>(count) - n.base);
}

bool Interpretation::is_true(std::span<const Int> clause) const {
  return std::any_of(clause.begin(), clause.end(), [&](Int lit) { return is_true(lit); });
}

void mutate(std::vector<Record>& records, Random& random) {
  const std::size_t at = random.below(records.size());
  Record& record = records[at];
  switch (random.below(7)) {
    case 0:
      records.erase(records.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1:
      records.insert(records.begin() + static_cast<std::ptrdiff_t>(random.below(records.size())),
                     Record(record));
      return;
    case 2:
      std::swap(records[at], records[random.below(records.size())]);
      return;
    case 3:
      if (!record.values.empty())
        record.values.erase(record.values.begin() +
                            static_cast<std::ptrdiff_t>(random.below(record.values.size())));
      return;
    case 4:
      if (!record.values.empty()) {
        Int& value = record.values[random.below(record.values.size())];
        value = -value;
      }
      return;
    case 5:
      record.tag = records[random.below(records.size())].tag;
      return;
    default:
      if (!record.values.empty())
        record.values[random.below(record.values.size())] +=
            random.percent(50) ? 1 : -static_cast<Int>(random.between(1, 3));
  }
}

std::string bytes_of(const std::vector<Record>& records) {
  std::string bytes = "qcert 1 bin\n";
  const auto put = [&](std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes += static_cast<char>(value | 128);
    bytes += static_cast<char>(value);
  };
  for (const Record& record : records) {
    bytes += record.tag;
    put(record.values.size());
    for (const Int value : record.values)
      put(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }
  return bytes;
}

}  // namespace quadrille_check::support
