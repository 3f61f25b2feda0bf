#pragma once
// VRML text -> the elements that X3D's XML encoding of the same document has.

#include "import/x3d/elements.h"

#include <string>
#include <string_view>

namespace imgeo::x3d {

/// Safe for untrusted text. Prototypes become ProtoDeclare, ProtoInstance and ExternProtoDeclare, routes become ROUTE,
/// and a DEF that repeats an earlier name gets a number. Throws Error{malformed, unsupported, limit} naming `name`,
/// line and column.
Elements parseVrml(std::string_view text, const std::string& name);

} // namespace imgeo::x3d
