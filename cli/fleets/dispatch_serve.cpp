// SPDX-License-Identifier: MIT
#include "fleets/dispatch_serve.hpp"

#include <cstddef>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fleets/dispatch_rmf.hpp"
#include "fleets/dispatch_words.hpp"
#include "frame/output.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::cli {
namespace {

using dispatch::Ticks;
using Json = nlohmann::ordered_json;

Error wrong(std::string message) { return {ErrorCode::syntax, std::move(message), {}}; }

/// Answers requests.
class Server {
 public:
  Server(const DispatchArguments& arguments, const text::Names& names, LiveFleet& fleet)
      : fleet_(fleet), words_(fleet, names), rmf_(fleet, words_) {
    limits_.wall_s = arguments.wall;
  }

  /// One line, without its end.
  [[nodiscard]] std::string answer(const std::string& line, std::size_t number) {
    const auto answer = this->answer(line);
    if (answer) return answer->dump();
    return Json({{"error", {{"line", number}, {"message", answer.error().message}}}})
        .dump(-1, ' ', false, Json::error_handler_t::replace);
  }

 private:
  using Handler = Result<Json> (Server::*)(const Json&);
  struct Request {
    Handler handle;
    std::set<std::string> needed, possible;
  };

  Result<Json> answer(const std::string& line) {
    static const std::map<std::string, Request> kRequests = {
        {"assign", {&Server::assign, {"robot", "goals"}, {"service", "deadline"}}},
        {"goal", {&Server::goal, {"robot", "one_of"}, {"cost_bias", "session"}}},
        {"cancel", {&Server::cancel, {"robot"}, {}}},
        {"report", {&Server::report, {"robot", "clock"}, {}}},
        {"close", {&Server::close, {"from", "to"}, {}}},
        {"open", {&Server::open, {"from", "to"}, {}}},
        {"tick", {&Server::tick, {"duration"}, {"held"}}},
        {"plans", {&Server::plans, {}, {}}}};
    const Json request = Json::parse(line, nullptr, false);
    if (request.is_discarded()) return wrong("this is no JSON");
    if (!request.is_object() || request.size() != 1 || !request.begin().value().is_object())
      return wrong("a request is an object with one key, whose value is an object");
    const std::string what = request.begin().key();
    const auto known = kRequests.find(what);
    if (known == kRequests.end())
      return wrong("there is no request '" + what +
                   "': assign, goal, cancel, close, open, report, tick, plans");
    const Json& given = request.begin().value();
    for (const auto& [key, value] : given.items())
      if (known->second.needed.count(key) + known->second.possible.count(key) == 0)
        return wrong("'" + what + "' has no \"" + key + "\"");
    for (const std::string& key : known->second.needed)
      if (!given.contains(key)) return wrong("'" + what + "' needs \"" + key + "\"");
    auto made = (this->*known->second.handle)(given);
    if (!made) return made.error();
    return Json({{what, *std::move(made)}});
  }

  Result<Json> assign(const Json& given) {
    const auto robot = words_.robot(given["robot"]);
    if (!robot) return robot.error();
    const Json& places = given["goals"];
    std::vector<VertexId> goals;
    // A name of a vertex may be a list, and then that is meant.
    if (const auto one = words_.vertex(places)) {
      goals.push_back(*one);
    } else {
      if (!places.is_array()) return one.error();
      for (const Json& place : places) {
        const auto vertex = words_.vertex(place);
        if (!vertex) return vertex.error();
        goals.push_back(*vertex);
      }
    }
    if (goals.empty()) return wrong("\"goals\" has none");
    dispatch::Task task{Goals(std::move(goals)), 0, {}};
    if (given.contains("service")) {
      const auto service = words_.ticks(given["service"], "service", true);
      if (!service) return service.error();
      task.service = *service;
    }
    if (given.contains("deadline")) {
      const auto deadline = words_.ticks(given["deadline"], "deadline", false);
      if (!deadline) return deadline.error();
      task.deadline = *deadline;
    }
    return assigned(*robot, std::move(task));
  }

  Result<Json> goal(const Json& given) {
    const auto robot = words_.robot(given["robot"]);
    if (!robot) return robot.error();
    auto goals = rmf_.goals(given, *robot);
    if (!goals) return goals.error();
    auto made = assigned(*robot, {*std::move(goals), 0, {}});
    if (made) rmf_.set_session(*robot, given);
    return made;
  }

  Result<Json> assigned(AgentId robot, dispatch::Task task) {
    if (const auto error = fleet_.assign(robot, std::move(task))) return *error;
    return Json({{"robot", words_.robot(robot)}, {"tasks", fleet_.num_tasks(robot)}});
  }

  Result<Json> cancel(const Json& given) {
    const auto robot = words_.robot(given["robot"]);
    if (!robot) return robot.error();
    if (const auto error = fleet_.cancel(*robot)) return *error;
    return Json({{"robot", words_.robot(*robot)}, {"tasks", fleet_.num_tasks(*robot)}});
  }

  Result<Json> close(const Json& given) {
    return change_lane(given, [this](VertexId a, VertexId b) { return fleet_.close(a, b); });
  }
  Result<Json> open(const Json& given) {
    return change_lane(given, [this](VertexId a, VertexId b) { return fleet_.open(a, b); });
  }
  template <class Change>
  Result<Json> change_lane(const Json& given, const Change& change) {
    const auto from = words_.vertex(given["from"]), to = words_.vertex(given["to"]);
    if (!from) return from.error();
    if (!to) return to.error();
    if (const auto error = change(*from, *to)) return *error;
    return Json({{"from", words_.vertex(*from)}, {"to", words_.vertex(*to)}});
  }

  Result<Json> report(const Json& given) {
    const auto robot = words_.robot(given["robot"]);
    if (!robot) return robot.error();
    const auto clock = words_.ticks(given["clock"], "clock", false);
    if (!clock) return clock.error();
    const auto out_of_range = [&](const char* what, Ticks bound) {
      return Error{ErrorCode::out_of_range,
                   std::string("\"clock\": ") + what + " " + Json(words_.time(bound)).dump(),
                   {}};
    };
    if (*clock < fleet_.clock(*robot))
      return out_of_range("clocks never go back, and it was", fleet_.clock(*robot));
    if (*clock > fleet_.limit(*robot))
      return out_of_range("the robot was allowed to go no further than to", fleet_.limit(*robot));
    if (const auto error = fleet_.report(*robot, *clock)) return *error;
    return Json({{"robot", words_.robot(*robot)}, {"clock", words_.time(fleet_.clock(*robot))}});
  }

  Result<Json> tick(const Json& given) {
    const auto duration = words_.ticks(given["duration"], "duration", true);
    if (!duration) return duration.error();
    if (*duration < 1) return wrong("\"duration\" is 0, and time has to go on");
    std::vector<AgentId> held;
    if (given.contains("held") && !given["held"].is_array()) return wrong("\"held\" is a list");
    for (const Json& called : given.contains("held") ? given["held"] : Json::array()) {
      const auto robot = words_.robot(called);
      if (!robot) return robot.error();
      held.push_back(*robot);
    }
    const auto called = fleet_.tick(*duration, held, limits_);
    if (!called) return called.error();
    const dispatch::News& news = *called;
    rmf_.note_courses();
    Json served = Json::array(), robots = Json::array();
    for (const AgentId robot : news.served) served.push_back(words_.robot(robot));
    for (std::size_t i = 0; i < fleet_.num_robots(); ++i) {
      const AgentId robot(i);
      Json course = Json::array();
      for (const dispatch::Stop& stop : fleet_.course(robot)) course.push_back(words_.stop(stop));
      robots.push_back({{"robot", words_.robot(robot)},
                        {"clock", words_.time(fleet_.clock(robot))},
                        {"limit", words_.time(fleet_.limit(robot))},
                        {"tasks", fleet_.num_tasks(robot)},
                        {"course", course}});
    }
    const auto cost = words_.time(Ticks(news.cost));
    const auto bound = words_.time(Ticks(news.lower_bound));
    return Json({{"now", words_.time(fleet_.now())},
                 {"served", served},
                 {"waiting", news.num_waiting},
                 {"new_plan", news.has_new_plan},
                 {"cost", cost},
                 {"lower_bound", bound},
                 {"gap_percent", bound > 0 ? 100 * (cost - bound) / bound : 0.0},
                 {"robots", robots}});
  }

  Result<Json> plans(const Json&) { return rmf_.messages(); }

  LiveFleet& fleet_;
  DispatchWords words_;
  DispatchRmf rmf_;
  Limits limits_;
};

}  // namespace

ExitCode serve(const DispatchArguments& arguments, const text::Names& names, LiveFleet& fleet) {
  Server server(arguments, names, fleet);
  std::string line;
  for (std::size_t number = 1; std::getline(std::cin, line); ++number)
    // At once, for whoever waits for it.
    if (const int failure = write_stdout(server.answer(line, number) + "\n"); failure != 0) {
      report_write_failure("-", failure);
      return ExitCode::output;
    }
  return ExitCode::success;
}

}  // namespace quadrille::cli
