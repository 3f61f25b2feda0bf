#pragma once
// Makes any text valid in XML 1.0 and HTML: character validity, escaping, and DEF names.

#include <map>
#include <string>
#include <string_view>

namespace imgeo {

/// Valid UTF-8: bytes that are not UTF-8, and characters that XML 1.0 forbids or discourages (control characters), are
/// replaced by U+FFFD.
std::string validText(std::string_view text);

/// Escapes text between tags.
std::string escapeText(std::string_view text);

/// Quotes an attribute value: with double quotes, or with single quotes if it contains double and no single quotes.
/// Line ends and tabs are escaped, so that parsers keep them.
std::string quoteAttribute(std::string_view text);

/// Assigns the DEF names of a document: unique, valid XML names without colons. Requested names that are valid and
/// unused are not changed.
class DefNames {
public:
  /// Assigns the requested name, made valid, with a number appended if the name is taken already. Returns "" for "".
  std::string take(std::string_view requested);

private:
  std::map<std::string, std::size_t> next_; ///< assigned name -> next number to append to it
};

} // namespace imgeo
