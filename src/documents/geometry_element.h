#pragma once
// The elements of one geometry: ImageGeometry or BinaryGeometry and its patches.

#include "containers/geometry_description.h"
#include "documents/element_writer.h"

#include <string>
#include <vector>

namespace imgeo {

/// bboxCenter and bboxSize, off by less than half a step of the lattice on which the
/// vertices are: more digits tell nothing. None for an empty box.
Attributes boxAttributes(const Box3d& box, const Lattice& lattice);
/// `position` and `size`, which say where the lattice lies, in no more digits than that takes.
Attributes decodeAttributes(const GeometryDescription& geometry);
std::string primTypes(const std::vector<Draw>& draws); ///< MFString
std::string counts(const std::vector<Draw>& draws);    ///< MFInt32

/// Whether the geometry's element says what there is to say of its only patch, whose box is
/// the shape's.
bool isSinglePatch(const GeometryDescription& geometry);

/// The geometry's element without its patches. `names` is its DEF, if any.
Element geometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names);
/// One further attribute of its vertices.
Element vertexAttributeElement(const AttributeDescription& attribute, Encoding encoding);
/// The element of a patch; not where the geometry's element is that of its only patch.
Element patchElement(const PatchDescription& patch, const GeometryDescription& geometry);

} // namespace imgeo
