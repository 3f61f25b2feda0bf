#pragma once
// X3D's MFString, a list of strings in one attribute (ISO/IEC 19776-1).

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// The strings, which stand in double quotes with backslashes before quotes and
/// backslashes; or one bare string. Takes text that breaks the rules for what it
/// most likely means.
std::vector<std::string> parseStrings(std::string_view text);

/// The text of such a list; every string in quotes.
std::string strings(const std::vector<std::string>& values);

} // namespace imgeo
