#pragma once
// Stored values of further vertex attributes: docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

namespace imgeo {

/// Describes the further attributes of a mesh, in their order. In SIG each number gets `bytes` bytes, spread over the
/// range of all values; whole numbers that fit exactly into fewer bytes get fewer.
std::vector<AttributeDescription> describeAttributes(const PatchedMesh& mesh, Encoding encoding, std::uint32_t bytes);

/// Converts a component to the integer that images store, and back.
std::uint32_t storeNumber(float value, const AttributeDescription& attribute, std::uint32_t component);
float loadNumber(std::uint32_t stored, const AttributeDescription& attribute, std::uint32_t component);

/// The maximum error of a stored number.
double numberErrorBound(Encoding encoding, const AttributeDescription& attribute, std::uint32_t component);

/// The number of files that hold an attribute of a patch.
std::size_t fileCountOf(Encoding encoding, const AttributeDescription& attribute);

/// Throws Error{malformed} unless a patch has the files of every attribute of its geometry.
void checkAttributes(const PatchDescription& patch, const GeometryDescription& geometry);

/// Channels of the images of an attribute: 1, 3 or 4 (two components take three).
std::uint32_t channelsOf(const AttributeDescription& attribute);

} // namespace imgeo
