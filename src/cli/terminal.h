#pragma once
// How a terminal is spoken to; files and pipes get plain text and no progress.

#include <chrono>
#include <cstdint>
#include <string>

namespace imgeo::cli {

/// Text in bold where standard output is a terminal that takes it and NO_COLOR
/// (https://no-color.org) is not set.
std::string bold(const std::string& text);

/// "1,234,567"
std::string grouped(std::uint64_t number);
/// "12.3 MB" (of a million bytes), "812 B"
std::string byteSize(std::uint64_t bytes);

/// One line on standard error that says how far the work is; nothing where that
/// is no terminal.
class ProgressBar {
public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// From any thread, one call at a time.
  void show(double share, const std::string& doing);

private:
  bool isTerminal_;
  std::string shown_;
  std::chrono::steady_clock::time_point last_;
};

} // namespace imgeo::cli
