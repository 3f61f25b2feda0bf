#pragma once
// Quantised patches <-> the payload of a file: docs/formats/compact.md.

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"
#include "containers/compact/header.h"

#include <span>
#include <string>
#include <vector>

namespace imgeo::compact {

struct EncodedPatches {
  Bytes bytes;
  /// Largest error of a normal of each patch in radians, quantisation included: a bound, measured for derived normals.
  std::vector<double> normalErrors;
};

/// Encodes the patches of one file. All vertices and wedges are used, values are within their ranges, and counts within
/// the limits of a header. Probabilities adapt from patch to patch. Decoding returns elements, vertices and wedges in
/// another order, with the orientation of triangles kept. Deterministic. `effort` is 0 .. 9: 0 uses the given mode of
/// normals, 1 to 6 choose the mode by a sample of the normals, 7 to 9 by all; 7, 8 and 9 encode 3, 6 and 13 orders of
/// each patch and keep the smallest file. Version 1 is for tests and for readers that know no other.
EncodedPatches encodePatches(std::span<const CompactPatch> patches, int effort, Version version = Version::two);

/// Decodes the patches of a payload. Safe for untrusted bytes: time and memory are proportional to counts that are
/// limited. Throws Error naming `location`.
std::vector<CompactPatch> decodePatches(ByteSpan payload, const std::string& location);

/// The types of the attributes of each patch. Reads only the header and the sizes. Throws Error naming `location`.
std::vector<std::vector<AttributeType>> attributesOfPatches(ByteSpan payload, const std::string& location);

} // namespace imgeo::compact
