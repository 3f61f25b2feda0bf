#pragma once
// Reading in a process of its own: what a library that was not made for bytes that
// nobody trusts does wrong, ends that process and not ours.

#include "import/import.h"

#include <functional>
#include <string>

namespace imgeo {

struct IsolationLimits {
  unsigned seconds = 120;                             ///< of processor time
  std::uint64_t memoryBytes = std::uint64_t{8} << 30; ///< of address space, beyond what is in use
};

/// Runs `read` in a child process and returns what it returns, or throws the Error
/// that it throws. A child that dies or takes too much is an Error{malformed} or
/// {limit} naming `location`.
Imported readIsolated(const std::function<Imported()>& read, const std::string& location,
                      const IsolationLimits& limits = {});

/// What is imported as bytes, and back: for the way between the two processes, which
/// are the same program.
Bytes packed(const Imported& imported);
Imported unpacked(ByteSpan bytes);

} // namespace imgeo
