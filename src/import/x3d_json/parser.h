#pragma once
// Parses X3D's JSON encoding into the elements of the same document in X3D's XML encoding.

#include "import/x3d/elements.h"

#include <string>
#include <string_view>

namespace imgeo::x3d {

/// Parses a document. "@name" is a field, "-name" a field that holds nodes, "#comment" a comment, and any other key a
/// statement; a field without its @ is accepted. Safe for untrusted text. Throws Error{malformed, limit} naming `name`,
/// line and column.
Elements parseX3dJson(std::string_view text, const std::string& name);

} // namespace imgeo::x3d
