// SPDX-License-Identifier: MIT
#pragma once

/// Around what a public header declares. Shared libraries are compiled with hidden visibility: they
/// offer what stands between these two, and nothing of their private parts or of CaDiCaL.
#if defined(__GNUC__)
#define QUADRILLE_API_BEGIN _Pragma("GCC visibility push(default)")
#define QUADRILLE_API_END _Pragma("GCC visibility pop")
#else
#define QUADRILLE_API_BEGIN
#define QUADRILLE_API_END
#endif
