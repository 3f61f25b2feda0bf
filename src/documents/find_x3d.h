#pragma once
// The <X3D> element in the text of a page or of an X3D file.

#include <cstddef>
#include <string>
#include <string_view>

namespace imgeo {

struct TextSpan {
  std::size_t begin = 0, end = 0; ///< bytes from the text's beginning
};

/// Finds the first <X3D> element, without regard to case, outside of comments,
/// scripts, styles and attribute values. Linear in the text, takes no memory.
/// Throws Error with name and line: malformed where there is no whole element,
/// unsupported for any document type but `<!doctype html>` (entities and
/// external subsets come with those).
TextSpan findX3d(std::string_view text, const std::string& name);

/// "name:line" of a byte of the text.
std::string locationOf(std::string_view text, const std::string& name, std::size_t at);

/// Whether two ASCII names are equal but for case.
bool equalIgnoringCase(std::string_view a, std::string_view b);

} // namespace imgeo
