// SPDX-License-Identifier: MIT
#include "frame/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "quadrille/core/terminal_text.hpp"

namespace quadrille::cli {
namespace {

Error io_error(const std::string& path, int code) {
  return {ErrorCode::io, fmt::format("cannot write: {}", std::strerror(code)), {path, 0}};
}

/// 0 or the errno of the failure. Goes on after a signal, so that an interrupt loses nothing.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// A file's text, which people read where the file is a terminal.
int write_file(int file, std::string_view text) {
  return ::isatty(file) == 1 ? write_all(file, terminal_text(text)) : write_all(file, text);
}

/// A name beside `target` that is this process's own.
std::string temporary_name(const std::string& target) {
  return fmt::format("{}.{}.tmp", target, ::getpid());
}

int create_temporary(const std::string& name) {
  return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/// Where a name leads, whether or not there is a file. Links are followed, to nothing as well.
std::filesystem::path resolve(const std::filesystem::path& name) {
  constexpr int kMaxLinks = 40;
  std::error_code ignored;
  std::filesystem::path path = name;
  if (std::filesystem::exists(path, ignored)) {
    path = std::filesystem::canonical(path, ignored);
    // What /proc names by a link, such as a pipe, may have no other name.
    return path.empty() ? name : path;
  }
  for (int i = 0; i < kMaxLinks && std::filesystem::is_symlink(path, ignored); ++i)
    path = path.parent_path() / std::filesystem::read_symlink(path, ignored);
  path = std::filesystem::weakly_canonical(path, ignored);
  return path.empty() ? name : path;
}

/// What tells files apart: the number of one that exists; of one that does not, its name and the
/// number of its folder, which may have many names.
class Identity {
 public:
  explicit Identity(const std::string& file) {
    if (file == "-") {
      exists_ = ::fstat(STDOUT_FILENO, &status_) == 0;
      return;
    }
    exists_ = ::stat(file.c_str(), &status_) == 0;
    if (exists_) return;
    const std::filesystem::path place = resolve(file), folder = place.parent_path();
    // Where the folder does not exist either, nothing can be written.
    if (::stat(folder.empty() ? "." : folder.c_str(), &status_) == 0) name_ = place.filename();
  }

  /// Whether what is written to one of them spoils the other.
  [[nodiscard]] bool clashes(const Identity& other) const {
    if (exists_ != other.exists_ || name_ != other.name_) return false;
    if (status_.st_dev != other.status_.st_dev || status_.st_ino != other.status_.st_ino)
      return false;
    return exists_ ? !S_ISCHR(status_.st_mode) : !name_.empty();
  }
  [[nodiscard]] bool is_regular() const { return exists_ && S_ISREG(status_.st_mode); }

 private:
  bool exists_;
  struct stat status_ {};  // Of the file, or of its folder.
  std::filesystem::path name_;
};

}  // namespace

std::string check_outputs(std::initializer_list<NamedOutput> named,
                          std::initializer_list<const std::string*> inputs, bool has_messages) {
  static const std::string kStdout = "-";
  std::vector<NamedOutput> outputs;
  for (const NamedOutput& output : named) {
    if (output.file->empty()) continue;
    outputs.push_back(output);
    has_messages = has_messages && *output.file != kStdout;
  }
  if (has_messages) outputs.push_back({"standard output", &kStdout});
  for (auto one = outputs.begin(); one != outputs.end(); ++one) {
    const Identity identity(*one->file);
    for (auto other = one + 1; other != outputs.end(); ++other) {
      const bool both_stdout = *one->file == "-" && *other->file == "-";
      if (both_stdout || identity.clashes(Identity(*other->file)))
        return fmt::format("{} and {} name the same output", one->option, other->option);
    }
    for (const std::string* input : inputs) {
      if (input->empty()) continue;
      if (input == one->replaces) continue;
      const Identity read(*input);
      if (read.is_regular() && identity.clashes(read))
        return (*one->file == "-" ? "standard output" : *one->file) + " is an input of this run";
    }
  }
  return "";
}

OutputFile::OutputFile(std::string path, std::string target, bool replace)
    : path_(std::move(path)), target_(std::move(target)), replace_(replace) {}

Result<OutputFile> OutputFile::probe(std::string path) {
  if (path == "-") return OutputFile(path, path, false);
  // Replacing a symbolic link itself would surprise.
  std::string target = resolve(path).string();

  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return io_error(path, EISDIR);
  if (exists && ::access(target.c_str(), W_OK) != 0) return io_error(path, errno);
  if (exists && !S_ISREG(status.st_mode)) return OutputFile(path, target, false);

  const std::string temporary = temporary_name(target);
  const int file = create_temporary(temporary);
  if (file < 0) {
    if (exists) return OutputFile(path, target, false);
    return io_error(path, errno);
  }
  ::close(file);
  ::unlink(temporary.c_str());
  return OutputFile(path, target, true);
}

int OutputFile::write(std::string_view text) const {
  if (is_stdout()) return write_stdout(text);
  if (replace_) return replace(text);
  const int file = ::open(target_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  const int code = write_file(file, text);
  return ::close(file) != 0 && code == 0 ? errno : code;
}

int OutputFile::replace(std::string_view text) const {
  const std::string temporary = temporary_name(target_);
  const int file = create_temporary(temporary);
  if (file < 0) return errno;
  struct stat status {};
  int code = 0;
  if (::stat(target_.c_str(), &status) == 0 && ::fchmod(file, status.st_mode & 07777) != 0)
    code = errno;
  if (code == 0) code = write_all(file, text);
  // Some file systems report a full disk only here.
  if (code == 0 && ::fsync(file) != 0) code = errno;
  if (::close(file) != 0 && code == 0) code = errno;
  if (code == 0 && ::rename(temporary.c_str(), target_.c_str()) != 0) code = errno;
  if (code != 0) ::unlink(temporary.c_str());
  return code;
}

bool is_colourful(int stream) {
  if (::isatty(stream) != 1) return false;
  const char* const refused = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  return (refused == nullptr || *refused == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

std::string in_colours(std::string_view text) {
  constexpr const char *kRed = "31", *kGreen = "32", *kYellow = "33";
  constexpr std::pair<std::string_view, const char*> kWords[] = {
      {"result     optimal", kGreen},  {"result     feasible", kYellow},
      {"result     infeasible", kRed}, {"result     unknown", kRed},
      {"verified   ", kGreen},         {"invalid    ", kRed}};
  std::string painted;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    std::string shown(line);
    for (const auto& [words, colour] : kWords) {
      if (!line.starts_with(words)) continue;
      // The key of a result stays as it is, so that columns of words look alike.
      const std::size_t from = words.starts_with("result") ? words.find_last_of(' ') + 1 : 0;
      const std::size_t to = words.find_last_not_of(' ') + 1;
      shown.insert(to, "\033[0m");
      shown.insert(from, fmt::format("\033[{}m", colour));
    }
    painted += shown;
    text.remove_prefix(line.size());
    if (text.empty()) break;
    painted += '\n';
    text.remove_prefix(1);
  }
  return painted;
}

void Console::print(std::string_view text) {
  if (quiet_ || failure_ != 0) return;
  const int stream = to_stderr_ ? STDERR_FILENO : STDOUT_FILENO;
  std::string shown = terminal_text(text);
  if (is_colourful(stream)) shown = in_colours(shown);
  const int code = write_all(stream, shown);
  if (!to_stderr_) failure_ = code;
}

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // Takes the lowest free number, which is this one; opened in the direction that is not used.
    if (::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

void print_stderr(std::string_view text) noexcept {
  try {
    static_cast<void>(write_all(STDERR_FILENO, terminal_text(text)));
  } catch (const std::bad_alloc&) {
    static_cast<void>(
        write_all(STDERR_FILENO, "quadrille: error: the system has no more memory\n"));
  }
}

void print_on_line(std::string_view text) {
  static_cast<void>(write_all(STDERR_FILENO, "\r" + terminal_line(text)));
}

void report_error(const Error& error) {
  print_stderr(fmt::format("quadrille: {}\n", error.to_string()));
}

void report_warning(const Error& warning) {
  print_stderr(fmt::format("quadrille: warning: {}\n", warning.to_string()));
}

void report_write_failure(const std::string& path, int code) {
  if (code != EPIPE) report_error(io_error(path == "-" ? "standard output" : path, code));
}

int write_stdout(std::string_view text) { return write_file(STDOUT_FILENO, text); }

bool write_or_report(const OutputFile& file, std::string_view text) {
  const int code = file.write(text);
  if (code != 0) report_write_failure(file.path(), code);
  return code == 0;
}

}  // namespace quadrille::cli
