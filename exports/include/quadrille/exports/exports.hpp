// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/exports/naming.hpp"
#include "quadrille/exports/ros.hpp"
#include "quadrille/exports/samples.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// What plans on roadmaps are exported to for other systems; docs/formats-of-others.md has the
/// fields.
enum class ExportFormat {
  csv,       ///< agent,time,x,y,vx,vy: samples.
  multidof,  ///< trajectory_msgs/MultiDOFJointTrajectory, one message per agent, as JSON.
  path,      ///< nav_msgs/Path, one message per agent, as JSON.
  vda5050,   ///< VDA 5050 orders, one per agent, as JSON.
  rmf_plan,  ///< rmf_prototype_msgs/Plan of Open-RMF, one per agent, as JSON.
  planviz,   ///< What PlanViz shows: an action per timestep of robots on a grid that turn.
};
[[nodiscard]] std::optional<ExportFormat> parse_export_format(std::string_view text) noexcept;

/// How samples are taken and written.
struct SampleOptions {
  ExportFormat format = ExportFormat::csv;  ///< csv, multidof or path.
  double rate = 10;                         ///< As in Sampler.
  RosVersion ros = RosVersion::two;
};
/// Why the plan cannot be written as samples: more than 10 million of them, or times that messages
/// cannot hold. Errors: out_of_range.
[[nodiscard]] std::optional<Error> why_no_samples(const continuous::Instance& instance,
                                                  const continuous::Plan& plan,
                                                  const SampleOptions& options);
/// The plan at moments, see Sampler. `yaws`: of the vertices of robots that turn, or null;
/// `robots`: their names. Requires a valid plan, and for messages one that ends by kLastRosSecond.
[[nodiscard]] std::string export_samples(const continuous::Instance& instance, const Yaws* yaws,
                                         const continuous::Plan& plan, const RobotNames& robots,
                                         const SampleOptions& options);

/// One JSON value per line, in a list.
class JsonLines {
 public:
  void add(const std::string& value) { text_ += (text_.empty() ? "[\n" : ",\n") + value; }
  [[nodiscard]] std::string text() const { return text_.empty() ? "[]\n" : text_ + "\n]\n"; }

 private:
  std::string text_;
};

}  // namespace quadrille::exports

QUADRILLE_API_END
