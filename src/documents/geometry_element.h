#pragma once
// The elements of one geometry: ImageGeometry or BinaryGeometry and its patches.

#include "containers/geometry_description.h"
#include "documents/element_writer.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// The fields bboxCenter and bboxSize, rounded by less than half a step of the lattice. None for an empty box.
Attributes boxAttributes(const Box3d& box, const Lattice& lattice);
/// The fields `position` and `size`, which define the lattice, with as few digits as the lattice allows.
Attributes decodeAttributes(const GeometryDescription& geometry);
std::string primTypes(const std::vector<Draw>& draws);    ///< the field primType, an MFString
std::string vertexCounts(const std::vector<Draw>& draws); ///< the field vertexCount, an MFInt32

/// Whether the geometry's element also describes its only patch, whose box is the shape's, without a GeometryPatch.
bool isSinglePatch(const GeometryDescription& geometry);

/// "normalType" ...: the field for the element type of a vertex attribute.
std::string typeFieldOf(VertexRole role);

/// "texCoordMin", "texCoordSize" ...: the fields for the box of a set of texture coordinates.
std::string minFieldOf(VertexRole role);
std::string sizeFieldOf(VertexRole role);

/// The box of a compact geometry of one patch as fields of its own, from which readers derive its lattice, so that
/// `position` and `size` are not needed. Empty where the box does not give the lattice.
std::optional<Attributes> boxWithLattice(const GeometryDescription& geometry);

/// The geometry's element without its patches. `names` is its DEF, if any. `box`, of boxWithLattice(), replaces
/// `position`, `size` and `profile`.
Element geometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names,
                        const std::optional<Attributes>& box = {});

/// The lattice that readers of a document get, bit for bit; that of `geometry` but for rounding in the last digits.
Lattice latticeInDocuments(const GeometryDescription& geometry);

/// The element of all geometries that differ from a shared one in their patch index: see
/// GeometryDescription::isShared. Its reference is that of patch 0.
Element sharedGeometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names);
/// The field `patch` of a Shape with a shared geometry, whose element has this DEF: "DEF#N".
std::string patchReference(const GeometryDescription& geometry, const std::string& name);

/// The FloatVertexAttribute element of a named attribute.
Element vertexAttributeElement(const AttributeDescription& attribute, Encoding encoding);
/// The GeometryPatch element of a patch; not for isSinglePatch() geometries.
Element patchElement(const PatchDescription& patch, const GeometryDescription& geometry);

} // namespace imgeo
