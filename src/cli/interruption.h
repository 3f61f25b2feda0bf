#pragma once
// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP into an exception, so that destructors remove unfinished files.

namespace imgeo::cli {

/// Thrown by throwIfInterrupted and caught in main. It is not an Error.
struct Interrupted {
  int signal;
};

/// Makes SIGINT, SIGTERM and SIGHUP set a flag instead of ending the process. A second signal of the same kind ends it.
void installSignalHandlers();

/// Throws Interrupted if a signal has arrived. Safe from any thread.
void throwIfInterrupted();

/// Ends the process by the signal, so that its parent process sees that a signal ended it.
[[noreturn]] void endProcessBySignal(Interrupted interrupted);

} // namespace imgeo::cli
