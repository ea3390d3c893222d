// SPDX-License-Identifier: MIT
#include "rules/meanings.hpp"

#include <algorithm>

namespace quadrille_check {

int Meanings::agent(Int number) const {
  require(number >= 0 && number < static_cast<Int>(instance_.agents().size()), "no such agent");
  return static_cast<int>(number);
}

int Meanings::place(Int number) const {
  require(instance_.has(number), "no such place");
  return static_cast<int>(number);
}

int Meanings::time(Int number) {
  require(number >= 0 && number < kEndOfTime, "no such time");
  return static_cast<int>(number);
}

// variable agent kind ...
Variable Meanings::read_usage(std::span<const Int> values) const {
  Variable made;
  made.kind = Variable::Kind::does_not;
  require(values.size() >= 5, "the record is too short");
  const auto rest = values.subspan(3);
  if (values[2] == 0) {
    require(rest.size() == 2, "a point has a place and a time");
    made.visits = {{place(rest[0]), time(rest[1]), time(rest[1])}};
  } else if (values[2] == 1) {
    require(rest.size() == 3, "an edge has two places and a time");
    made.is_edge = true;
    made.from = place(rest[0]);
    made.to = place(rest[1]);
    made.time = time(rest[2]);
    require(instance_.are_joined(made.from, made.to), "no such edge");
  } else if (values[2] == 2) {
    require(rest.size() == 3, "a range has a place and two times");
    made.visits = {{place(rest[0]), time(rest[1]), rest[2] == -1 ? kForever : time(rest[2])}};
    require(made.visits[0].first <= made.visits[0].last, "a range that ends before it begins");
  } else {
    require(values[2] == 3 && rest.size() % 2 == 0, "no such usage");
    for (std::size_t k = 0; k < rest.size(); k += 2)
      made.visits.push_back({place(rest[k]), time(rest[k + 1]), time(rest[k + 1])});
  }
  return made;
}

void Meanings::add_variable(const Record& record) {
  const auto& values = record.values;
  require(values.size() >= 3, "the record is too short");
  Variable made;
  if (record.tag == 'f') {
    made = read_usage(values);
    made.agent = agent(values[1]);
  } else if (record.tag == 'c') {
    require(values.size() == 3, "a cost has an agent and a number");
    made.kind = Variable::Kind::costs_at_most;
    made.agent = agent(values[1]);
    made.number = time(values[2]);
  } else if (record.tag == 'x') {
    require(values.size() == 4, "a visit has an agent, a place and a time");
    made.kind = Variable::Kind::is_there;
    made.agent = agent(values[1]);
    made.visits = {{place(values[2]), time(values[3]), time(values[3])}};
  } else {
    require(values.size() == 3 && values[2] >= 1 && values[2] < kEndOfTime,
            "a counter's literal has a node and a number");
    require(node(values[1]).kind == Node::Kind::sum, "a counter's literal is about a sum");
    made.kind = Variable::Kind::number_is_at_least;
    made.node = values[1];
    made.number = values[2];
  }
  variables_.add(values[0], std::move(made));
}

void Meanings::add_node(const Record& record) {
  const auto& values = record.values;
  require(values.size() >= 3 && values[0] == num_nodes(),
          "nodes come in the order of their numbers");
  require(values[1] >= 0 && values[1] <= 4, "no such kind of node");
  Node made;
  made.kind = static_cast<Node::Kind>(values[1]);
  if (made.kind == Node::Kind::levels) {
    require(values.size() >= 5 && values[2] >= 2, "levels have a rank from 2, a base and nodes");
    made.rank = values[2];
    made.base = values[3];
    made.levels.assign(values.begin() + 4, values.end());
    for (std::size_t k = 0; k < made.levels.size(); ++k) {
      require(node(made.levels[k]).kind == Node::Kind::sum, "a level is a sum");
      require(k == 0 || is_at_most(made.levels[k], made.levels[k - 1]),
              "a level is at most the one before");
    }
  } else {
    require(values.size() == (made.kind == Node::Kind::literal ? 3U : 4U),
            "a node of another length");
    made.of = values[2];
    if (made.kind != Node::Kind::literal) made.base = values[3];
  }
  if (made.kind == Node::Kind::literal) static_cast<void>(variable(made.of));
  if (made.kind == Node::Kind::agent) static_cast<void>(agent(made.of));
  if (made.kind == Node::Kind::beyond)
    require(node(made.of).kind == Node::Kind::sum, "what is beyond a base is a sum's");
  if (made.kind == Node::Kind::sum) {
    static_cast<void>(node(made.of));
    static_cast<void>(node(made.base));
  } else {
    require(made.base >= 0 && made.base < kEndOfTime, "no such base");
  }
  nodes_.push_back(std::move(made));
}

const Node& Meanings::node(Int number) const {
  require(number >= 0 && number < num_nodes(), "no such node");
  return nodes_[static_cast<std::size_t>(number)];
}

Int Meanings::implied(Int number, Int lit) const {
  const Node& n = node(number);
  const Variable& x = variable(lit);
  if (n.kind == Node::Kind::literal) return lit == n.of ? 1 : 0;
  if (n.kind == Node::Kind::agent) {  // "costs more than k"
    const bool is_cost = x.kind == Variable::Kind::costs_at_most && lit < 0 && x.agent == n.of;
    return is_cost ? std::max<Int>(0, x.number + 1 - n.base) : 0;
  }
  if (x.kind != Variable::Kind::number_is_at_least || lit < 0) return 0;
  if (n.kind == Node::Kind::beyond) return x.node == n.of ? std::max<Int>(0, x.number - n.base) : 0;
  if (n.kind == Node::Kind::sum) return x.node == number ? x.number : 0;
  // All levels up to this one are at least as large.
  if (x.number < n.rank) return 0;
  for (std::size_t level = n.levels.size(); level > 0; --level)
    if (n.levels[level - 1] == x.node) return std::max<Int>(0, static_cast<Int>(level) - n.base);
  return 0;
}

bool Meanings::implies(Int lit, Int other) const {
  if (lit == other) return true;
  const Variable& x = variable(lit);
  const Variable& y = variable(other);
  if (x.kind != y.kind || x.number < y.number) return false;
  if (x.kind == Variable::Kind::costs_at_most) return lit < 0 && other < 0 && x.agent == y.agent;
  return x.kind == Variable::Kind::number_is_at_least && lit > 0 && other > 0 &&
         (x.node == y.node || is_at_most(x.node, y.node));
}

// Nodes are made of older ones, so this ends; what is nested too deep is not known.
bool Meanings::is_at_most(Int a, Int b) const {
  if (const auto known = at_most_.find({a, b}); known != at_most_.end()) return known->second;
  if (depth_ == kDeepest) return false;
  ++depth_;
  const Ints left = leaves(a), right = leaves(b);
  std::size_t at = 0;
  bool holds = true;
  for (std::size_t k = 0; k < left.size() && holds; ++k, ++at) {
    const Node& counted = node(left[k]);
    const auto is_other = [&](Int leaf) {
      const Node& n = node(leaf);
      return n.kind == Node::Kind::literal && implies(counted.of, n.of);
    };
    if (counted.kind != Node::Kind::literal) holds = false;
    while (holds && at < right.size() && !is_other(right[at])) ++at;
    holds = holds && at < right.size();
  }
  --depth_;
  at_most_[{a, b}] = holds;
  return holds;
}

Ints Meanings::leaves(Int number, std::size_t most) const {
  Ints todo{number}, found;
  while (!todo.empty()) {
    const Int top = todo.back();
    todo.pop_back();
    const Node& n = node(top);
    if (n.kind == Node::Kind::sum) {
      todo.push_back(n.base);
      todo.push_back(n.of);
    } else {
      found.push_back(top);
    }
    require(found.size() + todo.size() <= most, "a counter counts more than that");
  }
  return found;
}

}  // namespace quadrille_check
