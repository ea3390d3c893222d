// SPDX-License-Identifier: MIT
#include "campaign/run/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

namespace quadrille::cli::campaign {
namespace {

constexpr std::size_t kKeptErrors = 4000;
constexpr double kMiB = 1024.0 * 1024.0;

/// The program counts what its search has added; this is for the rest of the process.
double memory_ceiling_mib(std::int64_t limit_mib) {
  return 1.1 * static_cast<double>(limit_mib) + 256;
}

double wall_ceiling_s(const JobLimits& limits) {
  if (limits.wall_s) return *limits.wall_s + limits.grace_s;
  if (limits.cpu_s) return 20 * *limits.cpu_s + 60;
  return HUGE_VAL;
}

rlim_t cpu_ceiling_s(const JobLimits& limits) {
  return static_cast<rlim_t>(std::ceil(1.1 * *limits.cpu_s + limits.grace_s));
}

/// In the new process, before the program: only what is safe after a fork.
void limit_self(const JobLimits& limits) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (!limits.cpu_s) return;
  const rlim_t soft = cpu_ceiling_s(limits);
  const rlimit cpu{soft, soft + static_cast<rlim_t>(std::ceil(limits.grace_s))};
  ::setrlimit(RLIMIT_CPU, &cpu);
}

[[noreturn]] void become(char* const* words, int out, int err, int failure, pid_t parent,
                         const JobLimits& limits) {
  // A group of its own: what a terminal sends is for the campaign, which decides.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  const int null = ::open("/dev/null", O_RDONLY);
  if (null < 0 || ::dup2(null, STDIN_FILENO) < 0 || ::dup2(out, STDOUT_FILENO) < 0 ||
      ::dup2(err, STDERR_FILENO) < 0)
    ::_exit(127);
  limit_self(limits);
  ::execvp(words[0], words);
  const int code = errno;
  if (::write(failure, &code, sizeof code) < 0) ::_exit(126);
  ::_exit(127);
}

/// Resident memory now; 0 if the process has gone.
double resident_mib(pid_t pid) {
  std::array<char, 128> text{};
  const int file = ::open(fmt::format("/proc/{}/statm", pid).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t got = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  long long total = 0, resident = 0;
  if (got <= 0 || std::sscanf(text.data(), "%lld %lld", &total, &resident) != 2) return 0;
  return static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMiB;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void close_file(int& file) {
  if (file >= 0) ::close(std::exchange(file, -1));
}

}  // namespace

Child::Child(Child&& other) noexcept { *this = std::move(other); }

Child& Child::operator=(Child&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(out_, other.out_);
  std::swap(err_, other.err_);
  std::swap(began_, other.began_);
  std::swap(kill_at_, other.kill_at_);
  std::swap(limits_, other.limits_);
  std::swap(ended_, other.ended_);
  return *this;
}

Child::~Child() {
  close_file(out_);
  close_file(err_);
  if (pid_ <= 0) return;
  ::kill(-pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

Result<Child> Child::start(const std::string& program, const std::vector<std::string>& arguments,
                           const JobLimits& limits) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const auto fail = [&](int code) {
    return Error{
        ErrorCode::io, fmt::format("cannot start {}: {}", program, std::strerror(code)), {}};
  };
  std::array<std::array<int, 2>, 3> pipes{{{-1, -1}, {-1, -1}, {-1, -1}}};
  const auto close_all = [&] {
    for (auto& pipe : pipes)
      for (int& end : pipe) close_file(end);
  };
  for (auto& pipe : pipes)
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
      const int code = errno;
      close_all();
      return fail(code);
    }
  Child child;
  child.limits_ = limits;
  child.began_ = Clock::now();
  const pid_t self = ::getpid();
  child.pid_ = ::fork();
  if (child.pid_ == 0) become(argv.data(), pipes[0][1], pipes[1][1], pipes[2][1], self, limits);
  int code = child.pid_ < 0 ? errno : 0;
  if (code == 0) ::setpgid(child.pid_, child.pid_);  // Whoever of the two comes first.
  for (auto& pipe : pipes) close_file(pipe[1]);
  // Ends without a word when the program has taken over.
  if (code == 0 && ::read(pipes[2][0], &code, sizeof code) != sizeof code) code = 0;
  if (code != 0) {
    close_all();
    return fail(code);
  }
  child.out_ = std::exchange(pipes[0][0], -1);
  child.err_ = std::exchange(pipes[1][0], -1);
  close_all();
  for (const int file : {child.out_, child.err_}) ::fcntl(file, F_SETFL, O_NONBLOCK);
  return child;
}

void Child::read_streams() {
  std::array<char, 65536> block;
  const auto drain = [&](int& file, std::string& text) {
    while (file >= 0) {
      const ssize_t got = ::read(file, block.data(), block.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return;  // nothing yet
      if (got == 0) return close_file(file);
      text.append(block.data(), static_cast<std::size_t>(got));
    }
  };
  drain(out_, ended_.out);
  drain(err_, ended_.err);
  if (ended_.err.size() > kKeptErrors) ended_.err.erase(0, ended_.err.size() - kKeptErrors);
}

void Child::stop() {
  if (pid_ <= 0 || kill_at_) return;
  ::kill(-pid_, SIGTERM);
  kill_at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(limits_.grace_s));
}

void Child::enforce() {
  const auto now = Clock::now();
  if (kill_at_ && now >= *kill_at_) ::kill(-pid_, SIGKILL);
  if (ended_.enforced != Enforced::no || kill_at_) return;
  const std::chrono::duration<double> wall = now - began_;
  if (wall.count() > wall_ceiling_s(limits_)) {
    ended_.enforced = Enforced::wall_time;
    stop();
  } else if (limits_.memory_mib && resident_mib(pid_) > memory_ceiling_mib(*limits_.memory_mib)) {
    ended_.enforced = Enforced::memory;
    ::kill(-pid_, SIGKILL);  // There may be no time left to be polite.
  }
}

std::optional<Ended> Child::watch() {
  read_streams();
  enforce();
  int status = 0;
  rusage usage{};
  const pid_t reaped = ::wait4(pid_, &status, WNOHANG, &usage);
  if (reaped != pid_) return std::nullopt;
  pid_ = -1;
  read_streams();
  const std::chrono::duration<double> wall = Clock::now() - began_;
  ended_.wall_s = wall.count();
  ended_.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  ended_.peak_rss_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  if (WIFEXITED(status)) ended_.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended_.signal = WTERMSIG(status);
  if (limits_.cpu_s && ended_.enforced == Enforced::no &&
      (ended_.signal == SIGXCPU ||
       (ended_.signal == SIGKILL && ended_.cpu_s >= static_cast<double>(cpu_ceiling_s(limits_)))))
    ended_.enforced = Enforced::cpu_time;
  return std::move(ended_);
}

}  // namespace quadrille::cli::campaign
