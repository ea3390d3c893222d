// SPDX-License-Identifier: MIT
#include "cli/files/commands.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "frame/program.hpp"

namespace quadrille::cli::test {
namespace {

/// In the process of the command: never returns.
[[noreturn]] void become(const Words& words, const std::string& out, const std::string& err,
                         unsigned cpu_seconds) {
  const auto redirect = [](int stream, const char* file, int flags) {
    const int opened = ::open(file, flags, 0600);
    if (opened < 0 || ::dup2(opened, stream) < 0) ::_exit(127);
    ::close(opened);
  };
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_APPEND);
  redirect(STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  const rlimit limit{cpu_seconds, cpu_seconds};
  ::setrlimit(RLIMIT_CPU, &limit);
  Words copy = words;
  copy.insert(copy.begin(), "quadrille");
  std::vector<char*> argv;
  for (std::string& word : copy) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int code = run_program(static_cast<int>(copy.size()), argv.data());
  std::fflush(nullptr);
  ::_exit(code);
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Workshop::Workshop() : before_(std::filesystem::current_path()) {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "quadrille-files-XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
  std::filesystem::create_directory(folder_ / "in");
  std::filesystem::current_path(folder_ / "in");
}

Workshop::~Workshop() {
  std::error_code ignored;
  std::filesystem::current_path(before_, ignored);
  std::filesystem::remove_all(folder_, ignored);
}

Ended Workshop::run(const Words& words) {
  const std::filesystem::path out = folder_ / "stdout";
  std::error_code ignored;
  std::filesystem::remove(out, ignored);
  Ended ended = run(words, out);
  ended.out = read_file(out);
  return ended;
}

Ended Workshop::run_into(const std::string& file, const Words& words) {
  return run(words, std::filesystem::absolute(file));
}

Ended Workshop::run(const Words& words, const std::filesystem::path& out) {
  const std::filesystem::path err = folder_ / "stderr";
  history_ += "quadrille";
  for (const std::string& word : words) history_ += " " + quoted(word);
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) become(words, out.string(), err.string(), kCpuSeconds);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  Ended ended;
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  ended.err = read_file(err);
  history_ += "   # " +
              (WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                   : std::to_string(ended.code)) +
              "\n" + ended.err;
  return ended;
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace quadrille::cli::test
