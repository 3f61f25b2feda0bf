#pragma once
// Finds the <X3D> element in a text in XML, an X3D document or an XHTML page, and compares names as HTML does.

#include <cstddef>
#include <string>
#include <string_view>

namespace imgeo {

struct TextSpan {
  std::size_t begin = 0, end = 0; ///< bytes from the text's beginning
};

/// Finds the first <X3D> element, without regard to case, outside of comments, scripts, styles and attribute values.
/// Linear time, constant memory. Throws Error with name and line: malformed if there is no complete element,
/// unsupported for document types other than `<!doctype html>`, which could define entities and external subsets.
TextSpan findX3d(std::string_view text, const std::string& name);

/// "name:line" of a byte of the text.
std::string locationOf(std::string_view text, const std::string& name, std::size_t at);

/// Whether two ASCII names are equal without regard to case.
bool equalIgnoringCase(std::string_view a, std::string_view b);
/// Whether a text begins with an ASCII prefix, without regard to case.
bool beginsIgnoringCase(std::string_view text, std::string_view prefix);

} // namespace imgeo
