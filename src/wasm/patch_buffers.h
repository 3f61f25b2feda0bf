#pragma once
// Converts decoded patches to arrays for the GPU: their wedges are the vertices. The arrays equal those of
// web/src/decode/compact/patchBuffers.ts, byte for byte; web/src/decode/compact/wasmDecoder.test.ts compares them.

#include "containers/compact/compact_patch.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace imgeo::compact {

/// Type of the elements of an array. The values are those of web/src/decode/compact/wasmDecoder.ts.
enum class ElementType : std::uint8_t { int8, uint8, int16, uint16, uint32, float32 };

/// An array of numbers of one type; empty where a patch has no such array.
struct ElementArray {
  ElementType type = ElementType::uint8;
  std::uint32_t length = 0; ///< in elements
  std::unique_ptr<std::byte[]> bytes{};

  /// An array of zeros. T is one of the types of ElementType.
  template <typename T> static ElementArray zeros(std::size_t length);
  /// The elements; T is their type.
  template <typename T> T* as() { return reinterpret_cast<T*>(bytes.get()); }
};

/// `stride` elements for each vertex, of which the first `components` are used. Others are zero.
struct VertexArray {
  ElementArray elements;
  std::uint32_t components = 1, stride = 1;
};

struct AttributeBuffer {
  AttributeKind kind = AttributeKind::other;
  std::uint32_t bits = 8;
  VertexArray vertices;
};

struct PatchBuffers {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16, vertexCount = 0;
  /// Corners of lines, of triangles in the order of vertex_cache.h, or of a base's triangles in the order of
  /// `segments`. Empty for points, which are drawn in order.
  ElementArray index;
  VertexArray coord; ///< lattice integers; floats where they have more than 16 bits
  /// Normals: directions of any length, signed. Texture coordinates and colours: normalised unsigned integers. Others:
  /// unsigned integers, floats where they have more than 16 bits.
  std::vector<AttributeBuffer> attributes;
  std::vector<std::uint32_t> segments; ///< see CompactPatch::segments
  std::uint32_t segmentCount = 0;      ///< 0: a patch, not a base
};

/// The arrays of a patch that decodePatches returned.
PatchBuffers buffersOf(CompactPatch patch);

} // namespace imgeo::compact
