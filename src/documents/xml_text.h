#pragma once
// Text from anywhere -> text that XML 1.0 and HTML both hold and read alike.

#include <map>
#include <string>
#include <string_view>

namespace imgeo {

/// UTF-8 in which every byte that is no UTF-8 and every character that XML 1.0
/// forbids has become U+FFFD.
std::string validText(std::string_view text);

/// Between tags.
std::string escapeText(std::string_view text);

/// A quoted attribute value: in double quotes, or in single ones where only
/// double quotes stand inside. Line ends and tabs survive the parsers.
std::string quoteAttribute(std::string_view text);

/// The names of a document's elements: valid XML names without colons, each given
/// once. Names that are valid and not yet taken stay as they are.
class DefNames {
public:
  /// A name like `wish`, with a number behind it where that is taken; "" for "".
  std::string take(std::string_view wish);

private:
  std::map<std::string, std::size_t> next_; ///< taken name -> the number to try for who wants it too
};

} // namespace imgeo
