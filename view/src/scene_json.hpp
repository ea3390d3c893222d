// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/view/page.hpp"
#include "scene.hpp"

namespace quadrille::view {

/// The data of the page; view/page/scene.js reads them and says what each key means. JSON without
/// "<", so that nothing in it ends the element of the page that holds it.
[[nodiscard]] std::string scene_json(const Scene& scene, const PageOptions& options);

}  // namespace quadrille::view
