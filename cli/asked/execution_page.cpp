// SPDX-License-Identifier: MIT
#include "asked/execution_page.hpp"

#include <filesystem>

#include "asked/shown_names.hpp"
#include "quadrille/view/page.hpp"

namespace quadrille::cli {

void add_page(const std::shared_ptr<const input::RoadmapInput>& input, std::int64_t page_ticks,
              ExecutionCase& made) {
  made.page_ticks = page_ticks;
  made.position = [input](VertexId v) -> TrackRecorder::Place {
    const auto& p = input->instance.roadmap().position(v);
    TrackRecorder::Place place{static_cast<double>(p.x.value()), static_cast<double>(p.y.value()),
                               static_cast<double>(p.z.value())};
    // The rows of a grid go down, and so does y: a quarter turn to the right is one from x to y.
    if (input->poses) place.heading = 90.0 * static_cast<double>(input->poses->pose(v).heading);
    return place;
  };
  for (const continuous::Agent& agent : input->instance.agents())
    made.starts.push_back(agent.start);
  made.page = [input](const std::vector<view::Track>& tracks) {
    view::PageOptions options;
    options.title = std::filesystem::path(input->source).filename().string();
    options.agent_names = shown_names(input->names);
    return view::page(input->instance, tracks, options, input->cells_or_null());
  };
}

}  // namespace quadrille::cli
