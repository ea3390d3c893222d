// SPDX-License-Identifier: MIT
#include "roadmap/drawing.hpp"

namespace quadrille::cli {

std::string page_of(const input::RoadmapInput& input, const continuous::Plan& plan,
                    const view::PageOptions& options) {
  if (input.poses) return view::page(input.instance, plan, options, *input.poses);
  return view::page(input.instance, plan, options, input.grid_or_null());
}

Result<std::string> picture_of(const input::RoadmapInput& input, const continuous::Plan& plan,
                               const view::PictureOptions& options) {
  if (input.poses) return view::picture(input.instance, plan, options, *input.poses);
  return view::picture(input.instance, plan, options, input.grid_or_null());
}

}  // namespace quadrille::cli
