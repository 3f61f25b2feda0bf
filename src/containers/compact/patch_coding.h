#pragma once
// A patch in integers <-> the bytes that stand for it: docs/formats/compact.md.

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"

#include <string>

namespace imgeo::compact {

struct PatchBytes {
  Bytes bytes;
  /// Radians by which a normal may be off from what comes back, its quantising
  /// included: a bound, for derived normals one that was measured.
  double normalError = 0;
};

/// Encodes a patch, all of whose vertices and wedges are in use and whose values
/// are in their ranges. Elements, vertices and wedges come back in an order of
/// its own; which these are and how triangles are turned around is kept.
/// Deterministic. `effort` 0 .. 9: how many beginnings and predictions are tried;
/// 0 keeps to the stated mode of normals.
PatchBytes encodePatchBytes(const CompactPatch& patch, int effort);

/// Decodes the patch that begins at byte `first` of a payload. Safe for untrusted
/// bytes: takes time and memory in proportion to the header's counts, which are
/// limited. Throws Error naming `place`.
CompactPatch decodePatchBytes(ByteSpan payload, std::size_t first, const std::string& place);

} // namespace imgeo::compact
