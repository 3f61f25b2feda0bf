#pragma once
// Ctrl-C (SIGINT), SIGTERM and SIGHUP: the process ends within 200 ms and leaves no unfinished files, whatever it is
// doing. Where the work reports progress, an exception unwinds it; where it does not, such as inside a library that
// reads a file, a thread of its own removes the unfinished files and ends the process. So it does, with the exit code
// of files that cannot be read, where an input file is shortened while it is read (SIGBUS).

namespace imgeo::cli {

/// Thrown by throwIfInterrupted and caught in main. It is not an Error.
struct Interrupted {};

/// Makes SIGINT, SIGTERM and SIGHUP end the process as described above. A second signal ends it at once. Called before
/// other threads start, since they must inherit the set of blocked signals. A further call has no effect.
void handleSignals();

/// Throws Interrupted if a signal has arrived. Safe from any thread.
void throwIfInterrupted();

/// Returns at once if no signal has arrived. Otherwise says so and ends the process by the signal, so that its parent
/// process sees that a signal ended it.
void endProcessIfInterrupted();

} // namespace imgeo::cli
