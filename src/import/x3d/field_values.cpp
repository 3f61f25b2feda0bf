#include "import/x3d/field_values.h"

#include <charconv>

namespace imgeo::x3d {

namespace {

constexpr std::string_view separators = " \t\r\n,";

template <typename T> std::optional<std::vector<T>> parse(std::string_view text) {
  std::vector<T> values;
  for (std::size_t at = text.find_first_not_of(separators); at != text.npos;
       at = text.find_first_not_of(separators, at)) {
    if (text[at] == '+') // from_chars knows no plus
      ++at;
    T value{};
    const char* const begin = text.data() + at;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool endsWord = stop == end || separators.find(*stop) != separators.npos;
    if (error != std::errc() || !endsWord)
      return std::nullopt;
    values.push_back(value);
    at = static_cast<std::size_t>(stop - text.data());
  }
  return values;
}

} // namespace

std::optional<std::vector<double>> parseReals(std::string_view text) {
  return parse<double>(text);
}

std::optional<std::vector<std::int32_t>> parseIntegers(std::string_view text) {
  return parse<std::int32_t>(text);
}

bool parseBoolean(std::string_view text, bool fallback) {
  if (text == "true" || text == "TRUE" || text == "True")
    return true;
  if (text == "false" || text == "FALSE" || text == "False")
    return false;
  return fallback;
}

} // namespace imgeo::x3d
