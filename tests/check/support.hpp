// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "rules/checker.hpp"
#include "support/random.hpp"

namespace quadrille_check::support {

/// The checker's own form of an instance.
[[nodiscard]] Instance checked(const quadrille::discrete::Instance& instance);
/// How certificates call the places of a path.
[[nodiscard]] std::vector<int> places(const quadrille::discrete::Instance& instance,
                                      const quadrille::discrete::Path& path);

/// A grid of letters, "." and "@", rows apart by "/".
[[nodiscard]] Instance grid(const std::string& rows, const std::vector<Instance::Agent>& agents);

/// Why the records, without a head, are rejected; empty if they are not.
[[nodiscard]] std::string rejection(const Instance& instance, const std::string& lines);
[[nodiscard]] inline bool accepts(const Instance& instance, const std::string& lines) {
  return rejection(instance, lines).empty();
}

/// "verified" and what was proved, or why it was not.
struct Answer {
  bool is_verified = false;
  Verdict verdict;
  std::string reason;
};
[[nodiscard]] Answer ask(const Instance& instance, const std::string& certificate);

[[nodiscard]] std::vector<Record> records_of(const std::string& certificate);
/// As a certificate in the text form.
[[nodiscard]] std::string text_of(const std::vector<Record>& records);

/// In the binary form, which may say what the text form cannot.
[[nodiscard]] std::string bytes_of(const std::vector<Record>& records);
/// One change to a random record, of a kind that might matter.
void mutate(std::vector<Record>& records, quadrille::support::Random& random);

/// What variables and nodes are in one plan, given by its paths.
class Interpretation {
 public:
  Interpretation(const Meanings& meanings, std::vector<std::vector<int>> paths)
      : meanings_(meanings), paths_(std::move(paths)) {}
  [[nodiscard]] bool is_true(Int lit) const;
  [[nodiscard]] Int value(Int node) const;
  [[nodiscard]] bool is_true(std::span<const Int> clause) const;
  [[nodiscard]] Int cost(int agent) const;

 private:
  [[nodiscard]] int where(int agent, int time) const;
  [[nodiscard]] bool does(const Variable& usage) const;

  const Meanings& meanings_;
  std::vector<std::vector<int>> paths_;
};

}  // namespace quadrille_check::support
