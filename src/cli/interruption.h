#pragma once
// Ctrl-C, a request to end and a closed terminal, made into an exception at a
// place where everything can be put in order.

namespace imgeo::cli {

/// Thrown by throwIfInterrupted; no error, and nothing to catch but in main.
struct Interrupted {
  int signal;
};

/// From here on SIGINT, SIGTERM and SIGHUP are noted instead of ending the
/// process. A second one of the same kind ends it.
void noteInterruptions();

/// Throws Interrupted once a signal has been noted. Safe from any thread.
void throwIfInterrupted();

/// Ends the process by the signal, as its parent expects it.
[[noreturn]] void endBy(Interrupted interrupted);

} // namespace imgeo::cli
