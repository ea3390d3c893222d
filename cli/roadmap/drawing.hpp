// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/input/roadmap.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {

/// view::page, with the cells and headings that the input has.
[[nodiscard]] std::string page_of(const input::RoadmapInput& input, const continuous::Plan& plan,
                                  const view::PageOptions& options);
/// view::picture, likewise.
[[nodiscard]] Result<std::string> picture_of(const input::RoadmapInput& input,
                                             const continuous::Plan& plan,
                                             const view::PictureOptions& options);

}  // namespace quadrille::cli
