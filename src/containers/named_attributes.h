#pragma once
// How further attributes of vertices are stored: docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

namespace imgeo {

/// What a document says of the attributes of a mesh about to be encoded, in
/// their order. Images: each number of a vertex takes `bytes` bytes spread over the box of
/// all its values; where all are whole and fit, fewer bytes that hold them exactly.
std::vector<AttributeDescription> describeAttributes(const PatchedMesh& mesh, Encoding encoding, std::uint32_t bytes);

/// A component's number -> the integer that images hold, and back.
std::uint32_t storeNumber(float value, const AttributeDescription& attribute, std::uint32_t component);
float loadNumber(std::uint32_t stored, const AttributeDescription& attribute, std::uint32_t component);

/// By how much a stored number may be off.
double numberBound(Encoding encoding, const AttributeDescription& attribute, std::uint32_t component);

/// How many files hold an attribute of a patch.
std::size_t filesOf(Encoding encoding, const AttributeDescription& attribute);

/// Throws Error{malformed} unless a patch has as many files of each attribute as the geometry says.
void checkAttributes(const PatchDescription& patch, const GeometryDescription& geometry);

/// Channels of the images of an attribute: 1, 3 or 4 (two components take three).
std::uint32_t channelsOf(const AttributeDescription& attribute);

} // namespace imgeo
