// SPDX-License-Identifier: MIT
//
// A static library compiled against glibc >= 2.38 refers to the C23 flavour of fscanf, which older
// C libraries lack. The two differ in "%i" alone, which reads binary numbers in C23; CaDiCaL calls
// it once, to read its memory use from /proc. Compiled only where a program with CaDiCaL does not
// link without it.
#include <cstdarg>
#include <cstdio>

// Weak, so that nothing breaks when the C library or another archive has it after all.
extern "C" __attribute__((weak)) int __isoc23_fscanf(std::FILE* file, const char* format, ...);

extern "C" int __isoc23_fscanf(std::FILE* file, const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  const int result = std::vfscanf(file, format, arguments);
  va_end(arguments);
  return result;
}
