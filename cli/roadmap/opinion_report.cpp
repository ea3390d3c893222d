// SPDX-License-Identifier: MIT
#include "roadmap/opinion_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {

using continuous::in_input_units;
using continuous::Instance;
using continuous::Meeting;
using continuous::SecondOpinion;

std::string describe_opinion(const Instance& instance, const SecondOpinion& opinion) {
  const double tolerance = opinion.tolerance * instance.resolution().length;
  const auto collisions = static_cast<std::size_t>(
      std::count_if(opinion.meetings.begin(), opinion.meetings.end(),
                    [](const Meeting& meeting) { return meeting.collide; }));
  std::string text = fmt::format("fcl        {}", to_string(opinion.verdict));
  if (!opinion.broken.empty()) text += fmt::format(": {}", opinion.broken.front());
  text += fmt::format("; {} pair{} of bodies collide, {} touch to within {:.2g}\n", collisions,
                      collisions == 1 ? "" : "s", opinion.meetings.size() - collisions, tolerance);
  return text;
}

Json opinion_json(const Instance& instance, const SecondOpinion& opinion) {
  Json json;
  json["by"] = "fcl";
  json["verdict"] = to_string(opinion.verdict);
  json["tolerance"] = opinion.tolerance * instance.resolution().length;
  json["looks"] = opinion.num_looks;
  json["broken"] = opinion.broken;
  json["meetings"] = Json::array();
  for (const Meeting& meeting : opinion.meetings) {
    Json item;
    item["kind"] = meeting.collide ? "collision" : "touch";
    item["agents"] = {meeting.agent.index()};
    if (meeting.other) item["agents"].push_back(meeting.other->index());
    if (meeting.obstacle) item["obstacle"] = *meeting.obstacle;
    item["begin"] = in_input_units(meeting.begin, instance.resolution());
    item["end"] = in_input_units(meeting.end, instance.resolution());
    json["meetings"].push_back(item);
  }
  return json;
}

}  // namespace quadrille::cli
