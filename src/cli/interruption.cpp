#include "cli/interruption.h"

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

void waitForSignals(const sigset_t& signals) {
  int signal = 0;
  if (sigwait(&signals, &signal) != 0)
    return;
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
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) // a signal that nohup ignores stays ignored
      sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
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
