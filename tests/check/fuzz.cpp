// SPDX-License-Identifier: MIT
// Gives quadrille-check mutated and random files, and looks at its exit code, its time and its
// memory: it never crashes, hangs, or takes more than 20 times the size of what it reads.
//
// usage: quadrille_check_fuzz NUMBER SEED FOLDER CASE ...
// A case is what quadrille-check is called with, in one word: the last part is the certificate.
// FOLDER: where files are written. With the sanitizers this says more.
#undef main
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <new>
#include <random>
#include <sstream>
#include <string>
#include <vector>

int checker_main(int argc, char** argv);  // quadrille-check's

namespace {

std::size_t now = 0, peak = 0;  // bytes

void* counted(std::size_t size) {
  void* const memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory == nullptr) throw std::bad_alloc();
  now += malloc_usable_size(memory);
  peak = std::max(peak, now);
  return memory;
}
void release(void* memory) {
  if (memory != nullptr) now -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }

namespace {

constexpr unsigned kMostSeconds = 60;
constexpr std::size_t kMostTimes = 20, kBase = 500'000;

using Random = std::mt19937_64;
std::size_t below(Random& random, std::size_t bound) { return random() % bound; }

std::string read(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Numbers at which something could overflow, as text.
std::string odd_number(Random& random) {
  static const char* const kOdd[] = {"0",
                                     "-1",
                                     "1",
                                     "2",
                                     "-2",
                                     "268435455",
                                     "268435456",
                                     "2147483647",
                                     "-2147483648",
                                     "4294967296",
                                     "1e18",
                                     "2305843009213693952",
                                     "4611686018427387904",
                                     "9223372036854775807",
                                     "-9223372036854775808",
                                     "99999999999999999999"};
  return kOdd[below(random, std::size(kOdd))];
}

void mutate(std::string& text, Random& random) {
  const auto at = [&] { return below(random, text.size() + 1); };
  switch (below(random, 7)) {
    case 0:
      if (!text.empty())
        text[below(random, text.size())] ^= static_cast<char>(1 << below(random, 8));
      return;
    case 1:
      text.resize(at());
      return;
    case 2:
      text.insert(at(), 1, static_cast<char>(below(random, 256)));
      return;
    case 3: {
      const std::size_t from = at(), length = below(random, 40);
      text.insert(at(), text.substr(from, length));
      return;
    }
    case 4:
      text.erase(at(), below(random, 40));
      return;
    case 5: {  // in binary files a number of nine bytes
      for (int k = 0; k < 9; ++k) text.insert(at(), 1, static_cast<char>(128 + below(random, 128)));
      return;
    }
    default: {  // in text another number
      const std::size_t first = text.find_first_of("0123456789", at());
      if (first == std::string::npos) return;
      const std::size_t last = std::min(text.find_first_not_of("0123456789", first), text.size());
      text.replace(first, last - first, odd_number(random));
    }
  }
}

/// Records of any kind with small numbers, most of which there are.
std::string random_certificate(Random& random) {
  std::string text = below(random, 20) == 0 ? "" : "qcert 1 text\n";
  if (below(random, 10) != 0) text += "i " + std::to_string(1 + below(random, 4)) + " 0\n";
  for (std::size_t k = below(random, 60); k > 0; --k) {
    text += "aaacclffmxsnkebtuzqpd"[below(random, 21)];
    for (std::size_t n = 1 + below(random, 9); n > 0; --n)
      text +=
          " " + (below(random, 20) == 0 ? odd_number(random)
                                        : std::to_string(static_cast<int>(below(random, 12)) - 3));
    if (below(random, 3) == 0) text += " | -1 2";
    text += "\n";
  }
  return text;
}

std::size_t number = 0;  // of the file
void die(int) {
  static_cast<void>(!write(2, "it hangs\n", 9));
  std::fprintf(stderr, "file %zu\n", number);
  _exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 64;
  const std::size_t count = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t seed = std::strtoull(argv[2], nullptr, 10);
  const std::string folder = argv[3];
  std::signal(SIGALRM, die);
  std::map<int, std::size_t> codes;
  double worst = 0;
  std::ostringstream output;
  std::cout.rdbuf(output.rdbuf());
  std::streambuf* const errors = std::cerr.rdbuf(output.rdbuf());
  int failures = 0;
  for (; number < count; ++number) {
    Random random(seed + number);
    std::vector<std::string> words{"quadrille-check"};
    std::istringstream asked(argv[4 + below(random, static_cast<std::size_t>(argc - 4))]);
    for (std::string word; asked >> word;) words.push_back(word);
    std::size_t size = 0;
    const auto put = [&](std::string& word, const char* name, const std::string& content) {
      word = folder + "/" + name;
      std::ofstream(word, std::ios::binary) << content;
    };
    for (std::size_t k = 1; k < words.size(); ++k) {
      const bool is_certificate = k + 1 == words.size();
      const std::string& option = words[k - 1];
      if (!is_certificate && option != "--map" && option != "--scen" && option != "--instance")
        continue;
      std::string content = read(words[k]);
      if (is_certificate && below(random, 4) == 0) {
        content = random_certificate(random);
      } else if (is_certificate || below(random, 8) == 0) {
        for (std::size_t n = 1 + below(random, 4); n > 0; --n) mutate(content, random);
      }
      put(words[k], is_certificate ? "certificate" : option.c_str() + 2, content);
      size += content.size();
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    output.str("");
    const std::size_t before = peak = now;
    alarm(kMostSeconds);
    const int code = checker_main(static_cast<int>(arguments.size()), arguments.data());
    alarm(0);
    ++codes[code];
    const std::size_t taken = peak - before;
    if (taken > kBase)
      worst = std::max(worst, static_cast<double>(taken - kBase) / static_cast<double>(size));
    if (taken > kBase + kMostTimes * size || (code != 0 && code != 1 && code != 65)) {
      ++failures;
      std::fprintf(stderr, "file %zu: exit code %d, %zu bytes for %zu\n%s\n", number, code, taken,
                   size, output.str().c_str());
    }
  }
  std::cerr.rdbuf(errors);
  for (const auto& [code, times] : codes) std::printf("exit code %d: %zu\n", code, times);
  std::printf("memory beyond %zu bytes: at most %.1f times the size of the files\n", kBase, worst);
  return failures == 0 && codes[0] > 0 && codes[1] > 0 ? 0 : 1;
}
