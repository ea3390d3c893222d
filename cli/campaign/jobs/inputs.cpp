// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <fstream>
#include <set>

#include "campaign/jobs/job.hpp"
#include "campaign/jobs/stable_hash.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {
namespace {

std::optional<Error> compare(const std::string& path, const std::string& hash,
                             const char* new_list) {
  std::ifstream in;
  if (auto error = text::open_input(path, in)) return error;
  const auto text = text::read_all(in, path);
  if (!text) return text.error();
  if (StableHash().add(*text).hex() == hash) return std::nullopt;
  return Error{ErrorCode::invalid_instance,
               fmt::format("the file has changed since the jobs were made of it; {}", new_list),
               {path, 0}};
}

}  // namespace

std::optional<Error> find_change(const JobList& list, const std::string& manifest,
                                 const std::optional<std::vector<std::size_t>>& jobs) {
  if (!manifest.empty() && !list.manifest.empty())
    if (auto error =
            compare(manifest, list.manifest, "'quadrille campaign run' takes what it says now"))
      return error;
  std::set<std::string> words;  // file names among them
  if (jobs)
    for (const std::size_t job : *jobs)
      words.insert(list.jobs[job].instance.begin(), list.jobs[job].instance.end());
  for (const InputFile& input : list.inputs) {
    if (jobs && !words.contains(input.path)) continue;
    if (auto error = compare(input.path, input.hash,
                             "'quadrille campaign run' makes jobs of what it says now"))
      return error;
  }
  return std::nullopt;
}

}  // namespace quadrille::cli::campaign
