#include "cli/memory_size.h"

#include "base/error.h"

#include <cctype>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <string_view>

namespace imgeo::cli {

std::uint64_t memoryFrom(const std::string& text) {
  constexpr std::string_view suffixes = "KMGT";
  std::size_t used = 0;
  double number = 0;
  try {
    number = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  const std::size_t suffix = used < text.size() ? suffixes.find(static_cast<char>(std::toupper(text[used]))) : 0;
  if (used == 0 || text.size() != used + 1 || suffix == suffixes.npos || !(number > 0 && number < 1e6))
    throw Error(ErrorKind::usage, "--memory", fmt::format("'{}' is no size as 1G or 800M", text));
  return static_cast<std::uint64_t>(std::ldexp(number, 10 * static_cast<int>(suffix + 1)));
}

} // namespace imgeo::cli
