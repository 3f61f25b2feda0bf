#pragma once
// Text from anywhere -> text that XML 1.0 and HTML both hold and read alike.

#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// UTF-8 in which every byte that is no UTF-8 and every character that XML 1.0
/// forbids has become U+FFFD.
std::string validText(std::string_view text);

/// Between tags.
std::string escapeText(std::string_view text);

/// A quoted attribute value: in double quotes, or in single ones where only
/// double quotes stand inside. Line ends and tabs survive the parsers.
std::string quoteAttribute(std::string_view text);

/// The DEF of each shape: its name made a valid, unique XML name without colons;
/// empty for a shape without a name. Valid unique names stay as they are.
std::vector<std::string> defNames(const std::vector<Shape>& shapes);

} // namespace imgeo
