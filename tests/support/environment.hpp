// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace quadrille::support {

/// `count` times the environment variable QUADRILLE_TEST_SCALE, at least 1.
[[nodiscard]] std::size_t scaled(std::size_t count);
/// Whether QUADRILLE_NIGHTLY is set to something other than 0.
[[nodiscard]] bool nightly();
/// The one system that random tests run, QUADRILLE_TEST_SYSTEM; empty: all.
[[nodiscard]] std::string only_system();
/// The folder QUADRILLE_DATA, if it is set and not empty.
[[nodiscard]] std::optional<std::string> data_folder();

/// Keeps a text that is written to stderr if the process aborts meanwhile, so that a broken
/// contract or a failed assertion shows its case too. One at a time.
class AbortNote {
 public:
  explicit AbortNote(std::string text);
  ~AbortNote();
  AbortNote(const AbortNote&) = delete;
  AbortNote& operator=(const AbortNote&) = delete;

 private:
  std::string text_;
};

}  // namespace quadrille::support
