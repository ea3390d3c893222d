// SPDX-License-Identifier: MIT
#include "support/environment.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace quadrille::support {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::atomic<const std::string*> current_note = nullptr;

extern "C" void write_note(int signal) {
  if (const std::string* note = current_note.exchange(nullptr))
    if (::write(STDERR_FILENO, note->data(), note->size()) < 0) std::signal(signal, SIG_DFL);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

std::size_t scaled(std::size_t count) {
  const std::string text = variable("QUADRILLE_TEST_SCALE");
  if (text.empty()) return count;
  char* end = nullptr;
  const double factor = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !(factor > 0)) {
    std::fprintf(stderr, "QUADRILLE_TEST_SCALE is no positive number: %s\n", text.c_str());
    std::exit(1);
  }
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(factor * static_cast<double>(count))));
}

bool nightly() {
  const std::string text = variable("QUADRILLE_NIGHTLY");
  return !text.empty() && text != "0";
}

std::string only_system() { return variable("QUADRILLE_TEST_SYSTEM"); }

std::optional<std::string> data_folder() {
  std::string folder = variable("QUADRILLE_DATA");
  if (folder.empty()) return std::nullopt;
  return folder;
}

AbortNote::AbortNote(std::string text) : text_("\n" + std::move(text) + "\n") {
  std::signal(SIGABRT, write_note);
  current_note = &text_;
}

AbortNote::~AbortNote() {
  current_note = nullptr;
  std::signal(SIGABRT, SIG_DFL);
}

}  // namespace quadrille::support
