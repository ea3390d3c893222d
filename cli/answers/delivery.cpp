// SPDX-License-Identifier: MIT
#include "answers/delivery.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <utility>

namespace quadrille::cli {

bool Delivery::probe(const std::string& path, std::optional<OutputFile>& file) {
  if (path.empty()) return true;
  auto probed = OutputFile::probe(path);
  if (probed)
    file = std::move(probed.value());
  else
    report_error(probed.error());
  return probed.has_value();
}

bool Delivery::probe() {
  return probe(plan_, plan_file_) && probe(json_, json_file_) && probe(view_, view_file_) &&
         probe(svg_, svg_file_) && probe(proof_, proof_file_);
}

void Delivery::write(const OutputFile& file, const std::string& text) {
  const int code = file.write(text);
  if (code == 0) {
    delivered_ = true;
    return;
  }
  report_write_failure(file.path(), code);
  output_failed_ = true;
  // A reader that has left does not want the rest.
  if (code != EPIPE) unwritten_ = text;
}

void Delivery::write_plan(const std::optional<Result<std::string>>& text) {
  if (!plan_file_) return;
  if (!text) {
    console_.print(fmt::format("plan       none; {} is not written\n", plan_file_->path()));
  } else if (*text) {
    write(*plan_file_, text->value());
  } else {
    report_error(text->error());
    output_failed_ = true;
  }
}

void Delivery::write_interim_plan(const Result<std::string>& text) {
  if (plan_file_ && text) static_cast<void>(plan_file_->write(*text));
}

void Delivery::write_json(const std::string& text) {
  if (json_file_) write(*json_file_, text);
}

void Delivery::show(const std::optional<OutputFile>& file,
                    const std::optional<Result<std::string>>& text, std::string_view what) {
  if (!file) return;
  if (!text) {
    console_.print(fmt::format("{}none; {} is not written\n", what, file->path()));
    return;
  }
  if (!*text) {
    report_error(text->error());
    output_failed_ = true;
    return;
  }
  const int code = file->write(text->value());
  if (code == 0) return;
  report_write_failure(file->path(), code);
  output_failed_ = true;
}

void Delivery::print_summary(const std::string& summary, const std::string& picture) {
  console_.print(summary);
  console_.print(picture);
  if (console_.failure() == 0) return;
  report_write_failure("-", console_.failure());
  output_failed_ = true;
  if (console_.failure() != EPIPE) unwritten_ = summary + unwritten_;
}

ExitCode Delivery::finish(ExitCode code) {
  // A result that went nowhere would have to be computed again.
  if (!delivered_) print_stderr(unwritten_);
  return output_failed_ && code != ExitCode::internal ? ExitCode::output : code;
}

}  // namespace quadrille::cli
