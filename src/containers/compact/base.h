#pragma once
// The base of a geometry <-> bytes of a payload: docs/formats/compact.md, "Base".

#include "base/bytes.h"
#include "containers/container.h"
#include "prepare/base_mesh.h"

namespace imgeo {

/// The bytes of a base, as the payload of an image holds them behind each other.
/// What comes back has other numbers; positions of one part alone have moved by a
/// small share of an edge. Deterministic.
Bytes encodeBase(const BaseMesh& base, const GeometryDescription& geometry, std::uint32_t colorBits);

/// The image that holds such payloads. Throws Error{limit} for more than an image holds.
EncodedFile baseFile(const Bytes& payload);

/// Decodes a geometry's base. Safe for untrusted bytes. Throws Error naming the url.
BaseMesh decodeBase(const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
