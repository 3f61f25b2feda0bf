#pragma once
// The values of X3D's fields in its XML encoding (ISO/IEC 19776-1): numbers with
// blanks or commas between them, quoted strings.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

/// All numbers of a field; nothing where one of its words is none.
std::optional<std::vector<double>> parseReals(std::string_view text);
/// Whole numbers of 32 bits.
std::optional<std::vector<std::int32_t>> parseIntegers(std::string_view text);
/// "true" and "false" in any case; the fallback for anything else.
bool parseBoolean(std::string_view text, bool fallback);

} // namespace imgeo::x3d
