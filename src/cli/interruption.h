#pragma once
// Ctrl-C (SIGINT), SIGTERM and SIGHUP as an exception, so that destructors clean up.

namespace imgeo::cli {

/// Thrown by throwIfInterrupted and caught in main. It is not an Error.
struct Interrupted {
  int signal;
};

/// Makes SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process. A second signal of the same kind ends it.
void noteInterruptions();

/// Throws Interrupted if a signal has arrived. Safe from any thread.
void throwIfInterrupted();

/// Ends the process by the signal, so that its parent sees the cause.
[[noreturn]] void endBy(Interrupted interrupted);

} // namespace imgeo::cli
