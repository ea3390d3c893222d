// SPDX-License-Identifier: MIT
// quadrille-check: whether a certificate proves its claim. docs/certificates.md.
#include <charconv>
#include <exception>
#include <iostream>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "exports/export.hpp"
#include "rules/checker.hpp"
#include "timed/checker.hpp"

namespace quadrille_check {
namespace {

constexpr int kVerified = 0, kRejected = 1, kUsage = 64, kBadInput = 65, kMemory = 71, kOutput = 74;

constexpr const char* kHelp =
    "Checks that no plan of an instance costs less than a certificate says, and its plan.\n"
    "\n"
    "  quadrille-check --map M --scen S --agents K [OPTIONS] CERTIFICATE\n"
    "  quadrille-check --instance I.json [OPTIONS] CERTIFICATE\n"
    "\n"
    "  --objective O       what the certificate has to be about: sum-of-costs (default) or "
    "makespan\n"
    "  --passable LETTERS  letters of the map that are passable besides . and G\n"
    "  --blocked LETTERS   letters of the map that are blocked besides @, O and T\n"
    "  --print             write the certificate as text to standard output; checks nothing\n"
    "  --export-lrat A.cnf A.lrat\n"
    "                      write the propositional part for checkers of LRAT proofs\n"
    "  --export-pb A.opb A.pbp\n"
    "                      write the proof of the bound for checkers of pseudo-Boolean proofs\n"
    "  --help              print this\n"
    "\n"
    "Exit codes: 0 verified, 1 rejected, 64 wrong command line, 65 the instance cannot be read or "
    "is\n"
    "wrong, 71 no more memory, 74 an output cannot be written.\n";

struct Arguments {
  std::map<std::string, std::string> values;
  bool prints = false;
  std::string cnf, lrat, opb, pbp, certificate;

  [[nodiscard]] bool has(const char* option) const { return values.count(option) != 0; }
  [[nodiscard]] std::string get(const char* option, const char* otherwise = "") const {
    const auto found = values.find(option);
    return found == values.end() ? otherwise : found->second;
  }
};

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    const auto next = [&] {
      if (++k == words.size()) throw UsageError(word + " needs a value");
      return words[k];
    };
    if (word == "--print") {
      arguments.prints = true;
    } else if (word == "--export-lrat") {
      arguments.cnf = next();
      arguments.lrat = next();
    } else if (word == "--export-pb") {
      arguments.opb = next();
      arguments.pbp = next();
    } else if (word == "--map" || word == "--scen" || word == "--agents" || word == "--instance" ||
               word == "--objective" || word == "--passable" || word == "--blocked") {
      if (!arguments.values.emplace(word, next()).second)
        throw UsageError(word + " is given twice");
    } else if (word.size() > 1 && word[0] == '-') {
      throw UsageError("there is no option " + word);
    } else if (arguments.certificate.empty()) {
      arguments.certificate = word;
    } else {
      throw UsageError("there is one certificate");
    }
  }
  if (arguments.certificate.empty()) throw UsageError("a certificate is needed");
  if (arguments.prints) return arguments;
  const bool is_movingai = arguments.has("--map") && arguments.has("--scen") &&
                           arguments.has("--agents") && !arguments.has("--instance");
  const bool is_json = arguments.has("--instance") && !arguments.has("--map") &&
                       !arguments.has("--scen") && !arguments.has("--agents");
  if (!is_movingai && !is_json)
    throw UsageError("either --map, --scen and --agents are needed, or --instance");
  const std::string objective = arguments.get("--objective", "sum-of-costs");
  if (objective != "sum-of-costs" && objective != "makespan")
    throw UsageError("--objective is sum-of-costs or makespan");
  return arguments;
}

Instance read_grid(const Arguments& arguments) {
  const std::string count = arguments.get("--agents");
  int agents = -1;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), agents);
  if (error != std::errc() || end != count.data() + count.size() || agents < 0)
    throw UsageError("--agents is a natural number");
  return read_movingai(arguments.get("--map"), arguments.get("--scen"), agents,
                       arguments.get("--passable"), arguments.get("--blocked"));
}

int print(const std::string& content) {
  RecordReader reader(content);
  std::cout << "qcert 1 text\n";
  for (Record record; reader.next(record);) std::cout << record.text(reader.num_clauses()) << '\n';
  return std::cout.flush() ? kVerified : kOutput;
}

std::string text_of(const Verdict& verdict) {
  if (verdict.is_infeasible) return "verified: infeasible";
  const std::string objective = verdict.is_makespan ? "makespan" : "sum of costs";
  if (verdict.cost == verdict.bound)
    return "verified: optimal, " + objective + " " + std::to_string(verdict.bound);
  std::string text =
      "verified: no plan has a " + objective + " of less than " + std::to_string(verdict.bound);
  if (verdict.cost) text += " (plan in the file: " + std::to_string(*verdict.cost) + ")";
  return text;
}

template <class AnyChecker>
Verdict verdict_of(AnyChecker& checker, const Arguments& arguments, const std::string& content) {
  RecordReader reader(content);
  try {
    for (Record record; reader.next(record);) checker.check(record);
    const Verdict verdict = checker.verdict();
    const bool wants_makespan = arguments.get("--objective") == "makespan";
    require(verdict.is_makespan == wants_makespan, "the certificate is about another objective");
    return verdict;
  } catch (const Rejected& rejected) {
    throw Rejected("record " + std::to_string(reader.number()) + ": " + rejected.what());
  }
}

int finish(const Verdict& verdict) {
  std::cout << text_of(verdict) << '\n';
  return std::cout.flush() ? kVerified : kOutput;
}

int check_timed(const Arguments& arguments, const Json& root, const std::string& content) {
  if (!arguments.cnf.empty() || !arguments.opb.empty())
    throw UsageError("there are no exports for roadmaps");
  const Road road = read_road(root);
  TimedChecker checker(road);
  return finish(verdict_of(checker, arguments, content));
}

int check(const Arguments& arguments, const std::string& content) {
  const bool is_json = arguments.has("--instance");
  const std::string file = arguments.get("--instance");
  const Json root = is_json ? read_json_file(file) : Json();
  if (is_json && root.kind == '{' && root.find("roadmap") != nullptr)
    return check_timed(arguments, root, content);
  const Instance instance = is_json ? instance_of(root, file) : read_grid(arguments);
  Checker checker(instance);
  const Verdict verdict = verdict_of(checker, arguments, content);
  const bool are_written =
      (arguments.cnf.empty() || export_lrat(content, arguments.cnf, arguments.lrat)) &&
      (arguments.opb.empty() || export_pb(content, checker, arguments.opb, arguments.pbp));
  if (!are_written) {
    std::cerr << "quadrille-check: an export cannot be written\n";
    return kOutput;
  }
  return finish(verdict);
}

int run(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (word == "--help") {
      std::cout << kHelp;
      return kVerified;
    }
  const Arguments arguments = parse(words);
  const std::string content = read_file(arguments.certificate);
  return arguments.prints ? print(content) : check(arguments, content);
}

}  // namespace
}  // namespace quadrille_check

int main(int argc, char** argv) {
  using namespace quadrille_check;
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const Rejected& rejected) {
    std::cout << "rejected: " << rejected.what() << '\n';
    return kRejected;
  } catch (const BadInput& error) {
    std::cerr << "quadrille-check: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "quadrille-check: no more memory\n";
    return kMemory;
  } catch (const std::exception& error) {
    std::cerr << "quadrille-check: " << error.what() << "\n\n" << kHelp;
    return kUsage;
  }
}
