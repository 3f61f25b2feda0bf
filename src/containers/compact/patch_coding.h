#pragma once
// Patches in integers <-> the bytes that stand for them: docs/formats/compact.md.

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"

#include <span>
#include <string>
#include <vector>

namespace imgeo::compact {

struct EncodedPatches {
  Bytes bytes;
  /// Per patch: radians by which a normal may be off from what comes back, its quantising
  /// included: a bound, for derived normals one that was measured.
  std::vector<double> normalErrors;
};

/// Encodes the patches of one file, as many and as large as a header may state, all of
/// whose vertices and wedges are in use and whose values are in their ranges. Each is
/// coded with what the ones before it have taught. Elements, vertices and wedges of a
/// patch come back in an order of its own; which these are and how triangles are turned
/// around is kept. Deterministic. `effort` 0 .. 9: how much is tried. 0 keeps to the
/// stated mode of normals; to 6 the better one of a sample is chosen, and from 7 on that of all; 7, 8 and 9
/// find 2, 4 and 8 orders of each patch and keep the smallest file.
EncodedPatches encodePatches(std::span<const CompactPatch> patches, int effort);

/// Decodes the patches of a payload. Safe for untrusted bytes: takes time and memory in
/// proportion to counts that are limited. Throws Error naming `location`.
std::vector<CompactPatch> decodePatches(ByteSpan payload, const std::string& location);

/// The attributes of each patch, without decoding them; the same otherwise.
std::vector<std::vector<AttributeType>> attributesOfPatches(ByteSpan payload, const std::string& location);

} // namespace imgeo::compact
