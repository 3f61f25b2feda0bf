#pragma once
// The <X3D> element: one text for both documents.

#include "documents/documents.h"

namespace imgeo {

/// The element with all its children, indented by `level`, ending in a newline.
std::string x3dElement(const SceneDocument& document, std::size_t level);

} // namespace imgeo
