#include "cli/interruption.h"

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace imgeo::cli {

namespace {

std::atomic<int> notedSignal{0};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may touch nothing else");

void note(int signal) {
  notedSignal = signal;
}

} // namespace

void installSignalHandlers() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr); // a signal that nohup ignores stays ignored
  }
}

void throwIfInterrupted() {
  if (const int signal = notedSignal)
    throw Interrupted{signal};
}

void endProcessBySignal(Interrupted interrupted) {
  std::signal(interrupted.signal, SIG_DFL);
  std::raise(interrupted.signal);
  std::abort();
}

} // namespace imgeo::cli
