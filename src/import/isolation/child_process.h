#pragma once
// Runs a reader in a child process, so that a crash or runaway allocation of a library that is not safe for untrusted
// bytes ends the child and not the program.

#include "import/import.h"

#include <functional>
#include <string>

namespace imgeo {

struct ChildProcessLimits {
  unsigned seconds = 120;                             ///< processor time
  std::uint64_t memoryBytes = std::uint64_t{8} << 30; ///< address space beyond what the parent uses
};

/// Runs `read` in a child process; returns its result, or rethrows its Error. Also throws, naming `location`:
/// Error{malformed} where the child crashes, Error{limit} where it exceeds a limit, Error{io} where no child can be
/// started.
Imported readInChildProcess(const std::function<Imported()>& read, const std::string& location,
                            const ChildProcessLimits& limits = {});

} // namespace imgeo
