// SPDX-License-Identifier: MIT
#pragma once

namespace quadrille::support {

/// Whether the address sanitizer is in this program: it keeps memory that was given back, has some
/// of its own for each block, and needs more address space than a limit leaves.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define QUADRILLE_HAS_ADDRESS_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(QUADRILLE_HAS_ADDRESS_SANITIZER)
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif

}  // namespace quadrille::support
