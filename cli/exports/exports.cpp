// SPDX-License-Identifier: MIT
#include "exports/exports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/execution/node_order.hpp"
#include "quadrille/execution/releaser.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;
using continuous::Path;
using continuous::Ticks;
using Json = nlohmann::ordered_json;

constexpr std::pair<ExportFormat, std::string_view> kFormats[] = {
    {ExportFormat::csv, "csv"},
    {ExportFormat::multidof, "multidof"},
    {ExportFormat::path, "path"},
    {ExportFormat::vda5050, "vda5050"},
    {ExportFormat::planviz, "planviz"}};

/// In the instance's units; the velocity is that of what comes next.
struct Sample {
  double time = 0, x = 0, y = 0, z = 0, vx = 0, vy = 0, vz = 0;
};

class Sampler {
 public:
  Sampler(const Instance& instance, double rate) : instance_(instance), rate_(rate) {}

  [[nodiscard]] std::vector<Sample> samples(const Path& path) {
    samples_.clear();
    next_ = 0;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      add(path[k].vertex, path[k].vertex, path[k].arrive, path[k].depart);
      add(path[k].vertex, path[k + 1].vertex, path[k].depart, path[k + 1].arrive);
    }
    const auto [x, y, z] = place(path.back().vertex);
    samples_.push_back({units(path.back().arrive), x, y, z, 0, 0, 0});
    return samples_;
  }

 private:
  [[nodiscard]] double units(Ticks ticks) const {
    return continuous::in_input_units(ticks, instance_.resolution());
  }
  [[nodiscard]] std::array<double, 3> place(VertexId vertex) const {
    const auto& p = instance_.roadmap().position(vertex);
    return {continuous::in_input_units(p.x, instance_.resolution()),
            continuous::in_input_units(p.y, instance_.resolution()),
            continuous::in_input_units(p.z, instance_.resolution())};
  }
  /// From its beginning on, its end excluded.
  void add(VertexId from, VertexId to, Ticks begin, Ticks end) {
    if (begin == end) return;
    const double start = units(begin), stop = units(end);
    const auto [x0, y0, z0] = place(from);
    const auto [x1, y1, z1] = place(to);
    const double vx = (x1 - x0) / (stop - start), vy = (y1 - y0) / (stop - start),
                 vz = (z1 - z0) / (stop - start);
    samples_.push_back({start, x0, y0, z0, vx, vy, vz});
    next_ = std::max(next_, static_cast<std::int64_t>(std::floor(start * rate_)) + 1);
    for (; static_cast<double>(next_) / rate_ < stop; ++next_) {
      const double time = static_cast<double>(next_) / rate_, since = time - start;
      if (since > 0)
        samples_.push_back({time, x0 + vx * since, y0 + vy * since, z0 + vz * since, vx, vy, vz});
    }
  }

  const Instance& instance_;
  double rate_;
  std::int64_t next_ = 0;  // Of the multiples of 1 / rate_.
  std::vector<Sample> samples_;
};

Json point(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }
Json no_rotation() { return {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}, {"w", 1.0}}; }
Json duration(double time) {
  const auto nanoseconds = std::llround(time * 1e9);
  return {{"secs", nanoseconds / 1'000'000'000}, {"nsecs", nanoseconds % 1'000'000'000}};
}
Json header(double time) { return {{"stamp", duration(time)}, {"frame_id", "map"}}; }

// A trajectory begins when its header says, and its times count from there.
Json multidof(AgentId agent, const std::vector<Sample>& samples) {
  const double begin = samples.front().time;
  Json points = Json::array();
  for (const Sample& s : samples)
    points.push_back(
        {{"transforms", {{{"translation", point(s.x, s.y, s.z)}, {"rotation", no_rotation()}}}},
         {"velocities", {{{"linear", point(s.vx, s.vy, s.vz)}, {"angular", point(0, 0, 0)}}}},
         {"accelerations", Json::array()},
         {"time_from_start", duration(s.time - begin)}});
  return {{"header", header(begin)},
          {"joint_names", {fmt::format("agent{}", agent.value())}},
          {"points", points}};
}

Json nav_path(const std::vector<Sample>& samples) {
  Json poses = Json::array();
  for (const Sample& s : samples)
    poses.push_back(
        {{"header", header(s.time)},
         {"pose", {{"position", point(s.x, s.y, s.z)}, {"orientation", no_rotation()}}}});
  return {{"header", header(samples.front().time)}, {"poses", poses}};
}

Json order_message(const Instance& instance, AgentId agent, const Path& path,
                   const OrderState& state) {
  const double length = instance.resolution().length, time = instance.resolution().time;
  Json nodes = Json::array(), edges = Json::array();
  for (std::size_t k = state.first; k < path.size(); ++k) {
    const auto& p = instance.roadmap().position(path[k].vertex);
    nodes.push_back({{"nodeId", fmt::format("v{}", path[k].vertex.value())},
                     {"sequenceId", 2 * k},
                     {"released", k <= state.released},
                     {"nodePosition",
                      {{"x", continuous::in_input_units(p.x, instance.resolution())},
                       {"y", continuous::in_input_units(p.y, instance.resolution())},
                       {"mapId", "map"}}},
                     {"actions", Json::array()}});
    if (k + 1 == path.size()) break;
    const auto& q = instance.roadmap().position(path[k + 1].vertex);
    const double way = std::hypot(static_cast<double>((q.x - p.x).value()),
                                  static_cast<double>((q.y - p.y).value())) *
                       length;
    Json edge = {
        {"edgeId", fmt::format("v{}-v{}", path[k].vertex.value(), path[k + 1].vertex.value())},
        {"sequenceId", 2 * k + 1},
        {"released", k < state.released}};
    if (way > 0)
      edge["maximumSpeed"] =
          way / (static_cast<double>((path[k + 1].arrive - path[k].depart).value()) * time);
    edge["actions"] = Json::array();
    edges.push_back(edge);
  }
  return {{"headerId", state.update},
          {"timestamp", "1970-01-01T00:00:00.000Z"},
          {"version", "3.0.0"},
          {"manufacturer", "quadrille"},
          {"serialNumber", order_name(agent)},
          {"orderId", order_name(agent)},
          {"orderUpdateId", state.update},
          {"nodes", nodes},
          {"edges", edges}};
}

/// One element per line.
void append(std::string& text, const Json& item) {
  text += (text.empty() ? "[\n" : ",\n") + item.dump();
}
std::string finish(std::string text) { return text.empty() ? "[]\n" : text + "\n]\n"; }

}  // namespace

std::optional<ExportFormat> parse_export_format(std::string_view text) noexcept {
  for (const auto& [format, name] : kFormats)
    if (name == text) return format;
  return std::nullopt;
}

std::string export_samples(const Instance& instance, const continuous::Plan& plan,
                           ExportFormat format, double rate) {
  Sampler sampler(instance, rate);
  const bool is_flat = instance.is_flat();
  std::string text;
  if (format == ExportFormat::csv)
    text = is_flat ? "agent,time,x,y,vx,vy\n" : "agent,time,x,y,z,vx,vy,vz\n";
  for (const AgentId agent : instance.agent_ids()) {
    const auto samples = sampler.samples(plan.paths[agent]);
    if (format == ExportFormat::multidof) append(text, multidof(agent, samples));
    if (format == ExportFormat::path) append(text, nav_path(samples));
    if (format != ExportFormat::csv) continue;
    for (const Sample& s : samples)
      text += is_flat
                  ? fmt::format("{},{},{},{},{},{}\n", agent.value(), s.time, s.x, s.y, s.vx, s.vy)
                  : fmt::format("{},{},{},{},{},{},{},{}\n", agent.value(), s.time, s.x, s.y, s.z,
                                s.vx, s.vy, s.vz);
  }
  return format == ExportFormat::csv ? text : finish(std::move(text));
}

std::string order_name(AgentId agent) { return fmt::format("agent{}", agent.value()); }

std::string export_order(const Instance& instance, AgentId agent, const Path& path,
                         const OrderState& state) {
  return order_message(instance, agent, path, state).dump();
}

std::string export_orders(const Instance& instance, const continuous::Plan& plan,
                          const execution::Precedences& order) {
  const execution::Releaser releaser(order);
  std::string text;
  for (const AgentId agent : instance.agent_ids())
    append(text,
           order_message(instance, agent, plan.paths[agent], {0, releaser.released(agent), 0}));
  return finish(std::move(text));
}

std::vector<std::string> describe_lock_up(const execution::Precedences& order) {
  const execution::NodeOrder nodes = execution::node_order(order);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < nodes.cycle.size(); ++k) {
    const execution::MoveId& leader = nodes.cycle[k == 0 ? nodes.cycle.size() - 1 : k - 1];
    const execution::MoveId& follower = nodes.cycle[k];
    if (leader.agent == follower.agent) continue;  // Its own next move.
    const execution::TimedMove &led = order.at(follower), &leads = order.at(leader);
    lines.push_back(
        fmt::format("{} waits at v{}, on its way to v{}, for {} to come from v{} to v{}",
                    order_name(follower.agent), led.from.value(), led.to.value(),
                    order_name(leader.agent), leads.from.value(), leads.to.value()));
  }
  if (nodes.num_knots > 1)
    lines.push_back(fmt::format("and so on: {} moves wait in {} separate circles",
                                nodes.num_knotted_moves, nodes.num_knots));
  return lines;
}

}  // namespace quadrille::cli
