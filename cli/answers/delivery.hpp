// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frame/exit_codes.hpp"
#include "frame/output.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli {

/// The outputs of one solve: a file for the plan, one for the result, one each for a page, a
/// picture and a certificate, and the console. A result that none of them takes ends up on stderr.
class Delivery {
 public:
  /// File names; empty for none, "-" for standard output.
  Delivery(bool quiet, std::string plan, std::string json, std::string view = "",
           std::string svg = "", std::string proof = "")
      : plan_(std::move(plan)),
        json_(std::move(json)),
        view_(std::move(view)),
        svg_(std::move(svg)),
        proof_(std::move(proof)),
        console_(quiet,
                 plan_ == "-" || json_ == "-" || view_ == "-" || svg_ == "-" || proof_ == "-") {}

  /// Whether all files can be written, as far as that is known beforehand. Says why not.
  [[nodiscard]] bool probe();

  [[nodiscard]] Console& console() noexcept { return console_; }
  [[nodiscard]] bool has_plan_file() const noexcept { return !plan_.empty(); }

  /// `text`: the plan, or why it cannot be expressed; nullopt without a plan.
  void write_plan(const std::optional<Result<std::string>>& text);
  /// A plan that is not the last one. Nothing is said if that fails: the last one will fail, too.
  void write_interim_plan(const Result<std::string>& text);
  [[nodiscard]] bool has_json_file() const noexcept { return json_file_.has_value(); }
  void write_json(const std::string& text);
  [[nodiscard]] bool has_view_file() const noexcept { return view_file_.has_value(); }
  [[nodiscard]] bool has_svg_file() const noexcept { return svg_file_.has_value(); }
  /// `text`: what is to be seen, or why it cannot be drawn; nullopt without a plan. Pictures do not
  /// count as a place for the result.
  void write_view(const std::optional<Result<std::string>>& text) {
    show(view_file_, text, "picture    ");
  }
  void write_svg(const std::optional<Result<std::string>>& text) {
    show(svg_file_, text, "picture    ");
  }
  [[nodiscard]] bool has_proof_file() const noexcept { return proof_file_.has_value(); }
  /// Likewise a certificate.
  void write_proof(const std::optional<Result<std::string>>& bytes) {
    show(proof_file_, bytes, "proof      ");
  }
  /// The end of the human output.
  void print_summary(const std::string& summary, const std::string& picture);
  /// `code`, unless an output failed.
  [[nodiscard]] ExitCode finish(ExitCode code);

 private:
  static bool probe(const std::string& path, std::optional<OutputFile>& file);
  void write(const OutputFile& file, const std::string& text);
  void show(const std::optional<OutputFile>& file, const std::optional<Result<std::string>>& text,
            std::string_view what);

  std::string plan_, json_, view_, svg_, proof_;
  Console console_;
  std::optional<OutputFile> plan_file_, json_file_, view_file_, svg_file_, proof_file_;
  bool delivered_ = false;  // a file with the result has been written
  bool output_failed_ = false;
  std::string unwritten_;  // the text of an output that failed
};

}  // namespace quadrille::cli
