#pragma once
// The elements of one geometry: ImageGeometry or BinaryGeometry and its patches.

#include "containers/geometry.h"
#include "documents/element.h"

#include <string>
#include <vector>

namespace imgeo {

Attributes boxAttributes(const Box3d& box);            ///< bboxCenter and bboxSize; none for an empty box
std::string primTypes(const std::vector<Draw>& draws); ///< MFString
std::string counts(const std::vector<Draw>& draws);    ///< MFInt32

/// The geometry's element without its patches. `names` is its DEF, if any.
Element geometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names);
/// One further attribute of its vertices.
Element attributeElement(const AttributeDescription& attribute, Container container);
Element patchElement(const PatchDescription& patch, const GeometryDescription& geometry);

/// "ImageGeometry" or "BinaryGeometry".
const char* geometryNodeName(Container container);

} // namespace imgeo
