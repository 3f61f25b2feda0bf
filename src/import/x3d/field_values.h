#pragma once
// Parses field values of X3D's XML encoding (ISO/IEC 19776-1): numbers separated by blanks or commas, and booleans.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

/// All numbers of a field; empty where a word is not a number.
std::optional<std::vector<double>> parseReals(std::string_view text);
/// All 32-bit integers of a field; empty where a word is not one.
std::optional<std::vector<std::int32_t>> parseIntegers(std::string_view text);
/// "true", "TRUE" or "True", and likewise "false"; the fallback for any other text.
bool parseBoolean(std::string_view text, bool fallback);

} // namespace imgeo::x3d
