// SPDX-License-Identifier: MIT
#pragma once

namespace quadrille {

/// Thrown where a search finds that it has contradicted itself, so deep inside others that it
/// cannot say so otherwise. The searches of this library catch it and answer with an internal
/// error; nobody else gets to see it.
struct InternalError {
  const char* message;  ///< Lives for ever.
};

}  // namespace quadrille
