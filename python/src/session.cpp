// SPDX-License-Identifier: MIT
// Sessions: agents and roads that change, solved again and again.
#include "quadrille/continuous/session.hpp"

#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/continuous/in_words.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "solving.hpp"
#include "timed.hpp"
#include "timed_solving.hpp"

namespace quadrille::python {
namespace {

using continuous::EdgeId;
using continuous::Instance;
using continuous::MemberId;
using continuous::Roadmap;
using continuous::Ticks;

class Session {
 public:
  Session(std::shared_ptr<Roadmap> roadmap, const Sizes& sizes, const py::list& obstacles,
          double now, bool whole_moves)
      : roadmap_(std::move(roadmap)),
        sizes_(sizes),
        obstacles_(obstacles_of(obstacles, sizes)),
        now_(moment_of(now, sizes, "now: the session begins")),
        session_(roadmap_, resolution_of(sizes), obstacles_, now_, whole_moves) {}

  /// All of these as agents_of takes them, of one agent.
  std::size_t add(const Ints& start, const Ints& goals, std::size_t num_goals, const py::list& body,
                  const Doubles& speed, const py::dict& rules, const py::dict& called) {
    const auto agents =
        agents_of(*roadmap_, sizes_, start, goals, {num_goals}, body, speed, rules, called);
    return take(session_.add(agents.front())).index();
  }
  void change(std::size_t member, const Ints& start, const Ints& goals, std::size_t num_goals,
              const py::list& body, const Doubles& speed, const py::dict& rules,
              const py::dict& called) {
    const auto agents =
        agents_of(*roadmap_, sizes_, start, goals, {num_goals}, body, speed, rules, called);
    check(session_.change(MemberId(member), agents.front()));
  }
  void remove(std::size_t member) { check(session_.remove(MemberId(member))); }
  void put_under_way(std::size_t member, std::int64_t from, std::int64_t to, double fraction,
                     const std::optional<double>& begun, const std::string& who) {
    const EdgeId edge = edges_between(from, to).front();
    const auto& agent = session_.agent(MemberId(member));
    const auto& road = roadmap_->edge(edge);
    const auto whole = road.duration
                           ? road.duration
                           : continuous::travel_time(roadmap_->position(road.from),
                                                     roadmap_->position(road.to), agent.speed);
    if (!whole) refuse(who + " is in the middle of a move that takes too long");
    const Ticks behind = ticks_behind(fraction, begun, now_, *whole, sizes_, who);
    check(session_.put_under_way(MemberId(member), edge, behind));
  }
  /// All edges that lead there.
  void close(std::int64_t from, std::int64_t to) {
    for (const EdgeId edge : edges_between(from, to)) check(session_.close(edge));
  }
  void open(std::int64_t from, std::int64_t to) {
    for (const EdgeId edge : edges_between(from, to)) check(session_.open(edge));
  }

  void advance_to(double now, const continuous::Plan& plan) {
    check(session_.advance_to(moment_of(now, sizes_, "now: the session goes on"), plan));
    now_ = session_.now();
  }
  [[nodiscard]] double now() const {
    return continuous::in_input_units(now_, resolution_of(sizes_));
  }
  [[nodiscard]] std::vector<std::size_t> members() const {
    std::vector<std::size_t> numbers;
    for (const MemberId member : session_.members()) numbers.push_back(member.index());
    return numbers;
  }

  /// `called`: names for messages, as instance_of takes them.
  [[nodiscard]] TimedInstance instance(const py::dict& called) const {
    auto made = session_.instance();
    if (made) return TimedInstance(std::move(made).value());
    const Error error = in_words(made.error(), called);
    if (error.code != ErrorCode::no_plan) raise(error);
    return {error, TimedParts{roadmap_, agents(), resolution_of(sizes_), obstacles_, now_}};
  }

  py::dict solve(const TimedInstance& self, const py::dict& arguments) {
    if (self.no_plan()) return solve_refused(self, arguments);
    const auto set_options = [&](Arguments& given, const std::atomic<bool>& interrupt) {
      return options_of(self.resolution(), given, interrupt);
    };
    const auto search = [this](const Instance&, const continuous::SolveOptions& options) {
      return session_.solve(options);
    };
    return run_solve<continuous::Plan>(self.instance(), arguments, set_options, search);
  }

 private:
  [[nodiscard]] std::vector<EdgeId> edges_between(std::int64_t from, std::int64_t to) const {
    const VertexId source = vertex_of(from, roadmap_->num_vertices(), "edge");
    const VertexId target = vertex_of(to, roadmap_->num_vertices(), "edge");
    std::vector<EdgeId> edges;
    for (const EdgeId edge : roadmap_->out_edges(source))
      if (roadmap_->edge(edge).to == target) edges.push_back(edge);
    if (edges.empty())
      refuse("there is no edge from vertex " + std::to_string(from) + " to vertex " +
             std::to_string(to));
    return edges;
  }
  [[nodiscard]] std::vector<continuous::Agent> agents() const {
    std::vector<continuous::Agent> agents;
    for (const MemberId member : session_.members()) agents.push_back(session_.agent(member));
    return agents;
  }
  [[nodiscard]] Error in_words(const Error& error, const py::dict& called) const {
    std::vector<EdgeId> closed;
    for (std::size_t e = 0; e < roadmap_->num_edges(); ++e)
      if (session_.is_closed(EdgeId(e))) closed.emplace_back(e);
    const auto roads = std::make_shared<const Roadmap>(roadmap_->with_closed(closed));
    return continuous::in_words(error, roads, agents(), resolution_of(sizes_), obstacles_, now_,
                                words_of(called, resolution_of(sizes_)));
  }

  std::shared_ptr<Roadmap> roadmap_;
  const Sizes sizes_;
  const std::vector<continuous::MovingObstacle> obstacles_;
  Ticks now_;
  continuous::Session session_;
};

}  // namespace

void bind_session(py::module_& module) {
  py::class_<Session>(module, "Session")
      .def(py::init<std::shared_ptr<Roadmap>, const Sizes&, const py::list&, double, bool>())
      .def("add", &Session::add)
      .def("change", &Session::change)
      .def("remove", &Session::remove)
      .def("put_under_way", &Session::put_under_way)
      .def("close", &Session::close)
      .def("open", &Session::open)
      .def("advance_to", &Session::advance_to)
      .def("now", &Session::now)
      .def("members", &Session::members)
      .def("instance", &Session::instance)
      .def("solve", &Session::solve);
}

}  // namespace quadrille::python
