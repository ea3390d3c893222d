// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "frame/option_parser.hpp"
#include "quadrille/view/picture.hpp"

namespace quadrille::cli {

/// The picture that `solve` and `view` write.
struct PictureArguments {
  std::string file;  ///< Empty: none; "-" for standard output.
  view::PictureOptions options;
  bool has_details = false;  ///< Options that need --svg were given.
};

/// "--svg" and what goes with it.
void add_picture_options(CLI::App& app, PictureArguments& arguments, const std::string& group);
/// What is wrong with the combination; empty if nothing is.
[[nodiscard]] std::string check_picture_options(const PictureArguments& arguments);
/// Nullopt unless an agent was chosen that the instance does not have.
[[nodiscard]] std::optional<Error> check_picture_agents(const PictureArguments& arguments,
                                                        std::size_t num_agents);

}  // namespace quadrille::cli
