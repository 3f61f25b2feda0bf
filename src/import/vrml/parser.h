#pragma once
// Parses VRML into the elements of the same document in X3D's XML encoding.

#include "import/x3d/elements.h"

#include <string>
#include <string_view>

namespace imgeo::x3d {

/// Parses a document. Safe for untrusted text. Prototypes become ProtoDeclare, ProtoInstance and ExternProtoDeclare,
/// routes become ROUTE, and a DEF whose name is already in use gets a number as suffix. Throws Error{malformed,
/// unsupported, limit} naming `name`, line and column.
Elements parseVrml(std::string_view text, const std::string& name);

} // namespace imgeo::x3d
