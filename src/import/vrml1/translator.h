#pragma once
// Translates VRML 1.0 into the elements of an X3D document in XML encoding. VRML 1.0 is a state machine: properties and
// transforms apply to all shapes that follow within a Separator. In X3D each shape has its own Appearance, and groups
// have transforms.

#include "import/x3d/elements.h"

#include <string>
#include <string_view>

namespace imgeo::vrml1 {

/// Translates a document. Safe for untrusted text. What is damaged or has no counterpart in X3D is left out and
/// reported in Elements::warnings. Throws Error{malformed, truncated, limit} naming `name`, line and column; if strict,
/// for damage too.
x3d::Elements readVrml1(std::string_view text, const std::string& name, bool isStrict);

} // namespace imgeo::vrml1
