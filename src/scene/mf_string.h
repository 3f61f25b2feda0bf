#pragma once
// X3D's MFString, a list of strings in one attribute (ISO/IEC 19776-1).

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// Parses a list of strings in double quotes, in which backslashes escape quotes and backslashes, or one unquoted
/// string. Tolerates malformed text.
std::vector<std::string> parseStrings(std::string_view text);

/// The text of an MFString attribute; every string is quoted.
std::string quoteStrings(const std::vector<std::string>& values);

} // namespace imgeo
