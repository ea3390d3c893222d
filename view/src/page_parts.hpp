// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace quadrille::view {

/// The files of view/page/, as the build embeds them.
struct PageParts {
  std::string_view document;  ///< HTML with the marks @TITLE@, @STYLE@, @SCRIPT@ and @DATA@.
  std::string_view style;
  std::span<const std::string_view> scripts;  ///< One after the other they are one script.
};
[[nodiscard]] PageParts page_parts();

}  // namespace quadrille::view
