#pragma once
// Output for terminals. Files and pipes get plain text and no progress bar.

#include <chrono>
#include <cstdint>
#include <string>

namespace imgeo::cli {

/// Bold text if standard output is a terminal and NO_COLOR (https://no-color.org) is not set.
std::string bold(const std::string& text);

/// "1,234,567"
std::string grouped(std::uint64_t number);
/// "12.3 MB" (a MB is a million bytes), "812 B"
std::string byteSize(std::uint64_t bytes);

/// A progress bar on standard error, if that is a terminal.
class ProgressBar {
public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar, with `fraction` (0..1) of it filled. May be called from any thread, one call at a time.
  void show(double fraction, const std::string& step);

private:
  bool isTerminal_;
  std::string displayedLine_;
  std::chrono::steady_clock::time_point last_;
};

} // namespace imgeo::cli
