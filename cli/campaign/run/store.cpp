// SPDX-License-Identifier: MIT
#include "campaign/run/store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace quadrille::cli::campaign {
namespace {

// Bytes that no file reaches: a claim each, and the locks of those who append and who merge.
constexpr std::int64_t kFirstClaim = std::int64_t{1} << 61;
constexpr std::int64_t kAppendLock = std::int64_t{1} << 60;
constexpr std::int64_t kMergeLock = kAppendLock + 1;

std::int64_t byte_of(const std::string& job) {
  const std::uint64_t hash = std::stoull(job, nullptr, 16);
  return kFirstClaim + static_cast<std::int64_t>(hash & ((std::uint64_t{1} << 61) - 1));
}

/// 0 or the errno. `command`: F_OFD_SETLK or F_OFD_SETLKW.
int set_lock(int file, int command, short type, std::int64_t byte) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  while (::fcntl(file, command, &lock) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

/// The size of the file without what a killed writer has left behind the last line; -1 on failure.
std::int64_t size_of_whole_lines(int file, std::int64_t size) {
  std::array<char, 65536> block;
  while (size > 0) {
    const std::int64_t from = std::max<std::int64_t>(0, size - std::int64_t{block.size()});
    const auto wanted = static_cast<std::size_t>(size - from);
    if (::pread(file, block.data(), wanted, from) != static_cast<ssize_t>(wanted)) return -1;
    const std::string_view text(block.data(), wanted);
    const auto end = text.rfind('\n');
    if (end != std::string_view::npos) return from + static_cast<std::int64_t>(end) + 1;
    size = from;
  }
  return 0;
}

}  // namespace

Store::Store(Store&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      read_(other.read_),
      lines_(other.lines_) {}

Store::~Store() {
  if (file_ >= 0) ::close(file_);
}

Error Store::error(const std::string& what, int code) const {
  return {ErrorCode::io, fmt::format("{}: {}", what, std::strerror(code)), {path_.string(), 0}};
}

Result<Store> Store::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  Store store(path, file);
  if (file < 0) return store.error("cannot open", errno);
  const int code = set_lock(file, F_OFD_SETLKW, F_WRLCK, kAppendLock);
  if (code != 0) return store.error("the file system has no locks", code);
  set_lock(file, F_OFD_SETLK, F_UNLCK, kAppendLock);
  return store;
}

std::optional<Error> Store::read_new(const std::function<void(std::string_view, long)>& take) {
  std::string rest;
  std::array<char, 1 << 16> block;
  std::int64_t at = read_;
  while (true) {
    const ssize_t got = ::pread(file_, block.data(), block.size(), at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return error("cannot read", errno);
    if (got == 0) return std::nullopt;
    at += got;
    std::string_view text(block.data(), static_cast<std::size_t>(got));
    for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
      rest += text.substr(0, end);
      text.remove_prefix(end + 1);
      read_ += static_cast<std::int64_t>(rest.size()) + 1;
      take(rest, ++lines_);
      rest.clear();
    }
    rest += text;
  }
}

bool Store::try_claim(const std::string& job) {
  return set_lock(file_, F_OFD_SETLK, F_WRLCK, byte_of(job)) == 0;
}

void Store::release(const std::string& job) { set_lock(file_, F_OFD_SETLK, F_UNLCK, byte_of(job)); }

bool Store::is_claimed_elsewhere(const std::string& job) const {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte_of(job);
  lock.l_len = 1;
  return ::fcntl(file_, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

std::optional<Error> Store::append(std::string_view line) {
  const int code = set_lock(file_, F_OFD_SETLKW, F_WRLCK, kAppendLock);
  if (code != 0) return error("cannot lock", code);
  auto failure = append_locked(std::string(line) + "\n");
  set_lock(file_, F_OFD_SETLK, F_UNLCK, kAppendLock);
  return failure;
}

std::optional<Error> Store::begin_merge() {
  const int code = set_lock(file_, F_OFD_SETLKW, F_WRLCK, kMergeLock);
  if (code != 0) return error("cannot lock", code);
  return std::nullopt;
}

std::optional<Error> Store::append_locked(std::string_view text) {
  struct stat facts {};
  if (::fstat(file_, &facts) != 0) return error("cannot read", errno);
  const std::int64_t size = size_of_whole_lines(file_, facts.st_size);
  if (size < 0) return error("cannot read", errno);
  if (size != facts.st_size && ::ftruncate(file_, size) != 0) return error("cannot write", errno);
  int code = 0;
  for (std::int64_t at = size; !text.empty() && code == 0;) {
    const ssize_t written = ::pwrite(file_, text.data(), text.size(), at);
    if (written < 0 && errno != EINTR) code = errno;
    if (written <= 0) continue;
    at += written;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  // Some file systems say only here that the disk is full.
  if (code == 0 && ::fdatasync(file_) != 0) code = errno;
  if (code == 0) return std::nullopt;
  if (::ftruncate(file_, size) != 0) return error("cannot write, nor cut off the rest", code);
  return error("cannot write", code);
}

}  // namespace quadrille::cli::campaign
