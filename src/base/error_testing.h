#pragma once
// For tests: the names of kinds of errors in test vectors, which the runtime's tests read as well.

#include "base/error.h"

#include <array>

namespace imgeo::testing {

inline const char* nameOf(ErrorKind kind) {
  static constexpr std::array names{"io", "truncated", "malformed", "unsupported", "limit", "usage"};
  return names.at(static_cast<std::size_t>(kind));
}

} // namespace imgeo::testing
