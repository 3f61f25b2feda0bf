#pragma once
// The <X3D> element: one text for both documents; and the pieces of it that the
// dialect for X3DOM shares.

#include "documents/documents.h"
#include "documents/element.h"

#include <functional>

namespace imgeo {

/// The element with all its children, indented by `level`, ending in a newline.
std::string x3dElement(const SceneDocument& document, std::size_t level);

/// Writes what stands for one shape; `def` may be empty.
using WriteShape =
    std::function<void(ElementWriter&, const Shape&, const std::string& def, const GeometryDescription&)>;

/// The same element with other shapes.
std::string x3dElement(const SceneDocument& document, std::size_t level, const WriteShape& writeShape);

using Attributes = std::vector<Attribute>;

Attributes boxAttributes(const Box3d& box);            ///< bboxCenter and bboxSize; none for an empty box
std::string primTypes(const std::vector<Draw>& draws); ///< MFString
std::string counts(const std::vector<Draw>& draws);    ///< MFInt32
Element materialElement(const Material& material);

} // namespace imgeo
