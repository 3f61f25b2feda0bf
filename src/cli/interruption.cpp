#include "cli/interruption.h"

#include "base/error.h"
#include "base/unfinished_files.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace imgeo::cli {

namespace {

using namespace std::chrono_literals;

/// Time for the work to end by itself, through throwIfInterrupted().
constexpr auto unwindingTime = 100ms;

std::atomic<int> receivedSignal{0};
std::atomic<bool> isEnding{false};
std::atomic<bool> isInputShortened{false};
pid_t handlingProcess = 0; ///< the process that has called handleSignals

/// By which the thread that meets a shortened file wakes the one that waits for signals.
constexpr int inputShortened = SIGUSR1;

/// Ends the process by `signal`. Only the first of several threads does; the others wait for the end.
[[noreturn]] void endProcessBy(int signal) {
  if (isEnding.exchange(true))
    for (;;)
      pause();
  removeUnfinishedFiles();
  fmt::print(stderr, "imgeo: interrupted; nothing has changed\n");
  std::signal(signal, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(signal);
  std::abort();
}

/// Handles SIGBUS: the end of an input file that is mapped into memory (FileView) has been cut off. Handlers must not
/// remove files, so another thread does.
void onBusError(int) {
  if (getpid() != handlingProcess) { // a child process without that thread ends by the signal, which its parent reports
    std::signal(SIGBUS, SIG_DFL);
    return;
  }
  isInputShortened = true;
  kill(getpid(), inputShortened);
  for (;;)
    pause();
}

[[noreturn]] void endByShortenedInput() {
  removeUnfinishedFiles();
  fmt::print(stderr, "imgeo: an input file has been shortened while it was read; nothing has changed\n");
  std::_Exit(exitCode(ErrorKind::io));
}

void waitForSignals(const sigset_t& signals) {
  int signal = 0;
  do {
    if (sigwait(&signals, &signal) != 0)
      return;
    if (isInputShortened && !isEnding.exchange(true))
      endByShortenedInput();
  } while (signal == inputShortened);
  receivedSignal = signal;
  // From now on a second signal has its default effect, in this thread.
  for (const int each : {SIGINT, SIGTERM, SIGHUP})
    std::signal(each, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  std::this_thread::sleep_for(unwindingTime);
  endProcessBy(signal);
}

} // namespace

void handleSignals() {
  if (handlingProcess == getpid())
    return;
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) // a signal that nohup ignores stays ignored
      sigaddset(&signals, signal);
  }
  sigaddset(&signals, inputShortened);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  handlingProcess = getpid();
  std::signal(SIGBUS, onBusError);
  std::thread([signals] { waitForSignals(signals); }).detach();
}

void throwIfInterrupted() {
  if (receivedSignal != 0)
    throw Interrupted{};
}

void endProcessIfInterrupted() {
  if (const int signal = receivedSignal)
    endProcessBy(signal);
}

} // namespace imgeo::cli
