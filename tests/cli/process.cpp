// SPDX-License-Identifier: MIT
#include "cli/process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

namespace quadrille::cli::test {
namespace {

constexpr std::chrono::duration<double> kPatience(30);

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void redirect(int stream, const char* file) {
  const int opened = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || ::dup2(opened, stream) < 0) ::_exit(127);
  ::close(opened);
}

}  // namespace

Process::Process(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                 const std::string& stdout_file)
    : out_(folder / ".stdout"), err_(folder / ".stderr") {
  std::vector<std::string> words = {QUADRILLE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out = stdout_file.empty() ? out_.string() : stdout_file;
  pid_ = ::fork();
  if (pid_ != 0) return;
  if (stdout_file == "closed")
    ::close(STDOUT_FILENO);
  else
    redirect(STDOUT_FILENO, out.c_str());
  redirect(STDERR_FILENO, err_.c_str());
  ::execv(QUADRILLE_PROGRAM, argv.data());
  ::_exit(127);
}

Process::~Process() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void Process::signal(int number) const { ::kill(pid_, number); }

bool Process::has_signal(const std::string& set, int number) const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  for (std::string name, mask; status >> name; std::getline(status, mask))
    if (name == set) {
      std::getline(status, mask);
      return ((std::stoull(mask, nullptr, 16) >> (number - 1)) & 1U) != 0;
    }
  return false;
}

void Process::wait_until_caught(int number) const {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!has_signal("SigCgt:", number)) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << "the program does not catch the signal";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Process::wait_until_received(int number) const {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (has_signal("SigPnd:", number) || has_signal("ShdPnd:", number)) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << "the signal stays pending";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

double Process::cpu_seconds() const {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Finished Process::wait(double seconds) {
  const auto end = std::chrono::steady_clock::now() +
                   std::max(kPatience, std::chrono::duration<double>(seconds));
  const double cpu_limit = cpu_seconds() + seconds;
  Finished finished;
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end || cpu_seconds() > cpu_limit) {
      ADD_FAILURE() << "still running after " << seconds << " s";
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  pid_ = -1;
  if (WIFEXITED(status)) finished.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) finished.signal = WTERMSIG(status);
  finished.out = read_file(out_);
  finished.err = read_file(err_);
  return finished;
}

CliTest::CliTest() {
  std::string pattern = (std::filesystem::temp_directory_path() / "quadrille-cli-XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
  write("small.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n");
  write("small.scen",
        "version 1\n"
        "0\tsmall.map\t4\t3\t0\t0\t3\t0\t3\n"
        "0\tsmall.map\t4\t3\t3\t0\t3\t2\t2\n"
        "0\tsmall.map\t4\t3\t3\t2\t0\t2\t3\n"
        "0\tsmall.map\t4\t3\t0\t2\t0\t0\t2\n");
  write("corridor.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
  write("corridor.scen", "version 1\n0\tc\t3\t1\t0\t0\t2\t0\t2\n0\tc\t3\t1\t2\t0\t0\t0\t2\n");
}

CliTest::~CliTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string CliTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::string CliTest::read(const std::string& name) const { return read_file(path(name)); }

bool CliTest::exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    if (name != ".stdout" && name != ".stderr") names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Finished CliTest::run(const std::vector<std::string>& arguments,
                      const std::string& stdout_file) const {
  return Process(folder_, arguments, stdout_file).wait(60);
}

std::vector<std::string> CliTest::small(const std::string& command,
                                        const std::vector<std::string>& more) const {
  return std::vector<std::string>{
             command, "--map", path("small.map"), "--scen", path("small.scen"), "--agents", "3"} +
         more;
}

std::vector<std::string> CliTest::corridor(const std::string& command,
                                           const std::vector<std::string>& more) const {
  return std::vector<std::string>{
             command,    "--map", path("corridor.map"), "--scen", path("corridor.scen"),
             "--agents", "2"} +
         more;
}

std::vector<std::string> CliTest::hard(const std::string& command,
                                       const std::vector<std::string>& more) const {
  if (!exists("hard.map")) {
    const Finished made =
        run({"generate", "--kind", "room", "--width", "32", "--height", "32", "--room-size", "4",
             "--doors", "0.2", "--seed", "1", "--agents", "60", "--map-output", path("hard.map"),
             "--scen-output", path("hard.scen")});
    EXPECT_EQ(made.code, 0) << made.err;
  }
  return std::vector<std::string>{
             command, "--map", path("hard.map"), "--scen", path("hard.scen"), "--agents", "60"} +
         more;
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace quadrille::cli::test
