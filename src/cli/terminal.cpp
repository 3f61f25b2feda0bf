#include "cli/terminal.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace imgeo::cli {

namespace {

bool isTerminal(std::FILE* stream) {
  const char* kind = std::getenv("TERM");
  return isatty(fileno(stream)) && kind && std::string_view(kind) != "dumb";
}

} // namespace

std::string bold(const std::string& text) {
  const char* noColor = std::getenv("NO_COLOR");
  static const bool isBold = isTerminal(stdout) && !(noColor && *noColor);
  return isBold ? "\x1b[1m" + text + "\x1b[0m" : text;
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3)
    digits.insert(at - 3, 1, ',');
  return digits;
}

std::string byteSize(std::uint64_t bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB"};
  double size = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < units.size(); ++unit)
    size /= 1000;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", size, units[unit]);
}

ProgressBar::ProgressBar() : isTerminal_(isTerminal(stderr)) {}

ProgressBar::~ProgressBar() {
  if (!displayedLine_.empty())
    fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double fraction, const std::string& step) {
  if (!isTerminal_)
    return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(40))
    return;
  constexpr std::size_t width = 30;
  const auto full = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * width);
  const std::string line =
      fmt::format("[{:=<{}}{: <{}}] {:3.0f} % {}", "", full, "", width - full, fraction * 100, step);
  if (line == displayedLine_)
    return;
  fmt::print(stderr, "\r{}\x1b[K", line);
  std::fflush(stderr);
  displayedLine_ = line;
  last_ = now;
}

} // namespace imgeo::cli
