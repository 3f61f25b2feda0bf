#include "serve/range_header.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

namespace imgeo {

namespace {

/// The number that `text` consists of; the largest one for numbers of more than 64 bits.
std::optional<std::uint64_t> parseOffset(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [at, failure] = std::from_chars(text.data(), end, value);
  if (at != end || failure == std::errc::invalid_argument)
    return std::nullopt;
  return failure == std::errc::result_out_of_range ? std::numeric_limits<std::uint64_t>::max() : value;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

} // namespace

ByteRange parseRange(std::string_view header, std::uint64_t size) {
  using Kind = ByteRange::Kind;
  const ByteRange whole{Kind::whole, 0, size};
  header = trimmed(header);
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit))
    return whole;
  header = trimmed(header.substr(unit.size()));

  const std::size_t dash = header.find('-');
  if (dash == std::string_view::npos)
    return whole;
  const std::string_view firstText = header.substr(0, dash), lastText = header.substr(dash + 1);
  const auto first = parseOffset(firstText), last = parseOffset(lastText);
  if ((!first && !firstText.empty()) || (!last && !lastText.empty()))
    return whole;

  if (!first) {
    if (!last)
      return whole;
    // "-n": the last n bytes.
    const std::uint64_t count = std::min(*last, size);
    return count == 0 ? ByteRange{Kind::unsatisfiable, 0, 0} : ByteRange{Kind::partial, size - count, count};
  }
  if (last && *last < *first)
    return whole;
  if (*first >= size)
    return {Kind::unsatisfiable, 0, 0};
  return {Kind::partial, *first, std::min(last.value_or(size - 1), size - 1) - *first + 1};
}

} // namespace imgeo
