#pragma once
// Durations of steps.

#include <chrono>
#include <utility>

namespace imgeo {

class Stopwatch {
public:
  /// Seconds since construction or since the last call.
  double lapSeconds() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lap_, now)).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point lap_ = Clock::now();
};

} // namespace imgeo
