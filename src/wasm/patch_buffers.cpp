#include "wasm/patch_buffers.h"

#include "wasm/vertex_cache.h"

#include <cmath>
#include <type_traits>
#include <utility>

namespace imgeo::compact {

namespace {

/// WebGL 2 restarts a strip at the index 65535 of 16-bit indices, so that this index is not a vertex.
constexpr std::size_t maxUint16VertexCount = 65535;

template <typename T> constexpr ElementType elementTypeOf() {
  if constexpr (std::is_same_v<T, std::int8_t>)
    return ElementType::int8;
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return ElementType::uint8;
  else if constexpr (std::is_same_v<T, std::int16_t>)
    return ElementType::int16;
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return ElementType::uint16;
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return ElementType::uint32;
  else if constexpr (std::is_same_v<T, float>)
    return ElementType::float32;
}

/// An array with the components that `convert(vertex, component)` returns.
template <typename T, typename Convert>
VertexArray interleaved(std::size_t count, std::uint32_t components, std::uint32_t stride, const Convert& convert) {
  VertexArray vertices{ElementArray::zeros<T>(stride * count), components, stride};
  T* to = vertices.elements.as<T>();
  for (std::size_t vertex = 0; vertex < count; ++vertex, to += stride)
    for (std::uint32_t i = 0; i < components; ++i)
      to[i] = static_cast<T>(convert(vertex, i));
  return vertices;
}

VertexArray coordOf(const CompactPatch& patch) {
  const auto coordinate = [&](std::size_t wedge, std::uint32_t axis) {
    return patch.positions[patch.wedgePositions[wedge]][static_cast<int>(axis)];
  };
  if (patch.positionBits <= 8)
    return interleaved<std::uint8_t>(patch.wedgeCount(), 3, 4, coordinate);
  if (patch.positionBits <= 16)
    return interleaved<std::uint16_t>(patch.wedgeCount(), 3, 4, coordinate);
  return interleaved<float>(patch.wedgeCount(), 3, 3, coordinate);
}

template <typename T> VertexArray copied(const Attribute& attribute, std::uint32_t stride) {
  return interleaved<T>(attribute.values.size(), attribute.type.components, stride,
                        [&](std::size_t wedge, std::uint32_t i) { return attribute.values[wedge][i]; });
}

/// Scales integers of `bits` bits to the whole range of T.
template <typename T> VertexArray normalised(const Attribute& attribute, std::uint32_t stride) {
  const std::uint32_t maxInput = (1u << attribute.type.bits) - 1, maxOutput = std::numeric_limits<T>::max();
  if (maxInput == maxOutput)
    return copied<T>(attribute, stride);
  // In the same order as the other reader: floating point is not associative.
  const double factor = static_cast<double>(maxOutput) / maxInput;
  return interleaved<T>(
      attribute.values.size(), attribute.type.components, stride,
      [&](std::size_t wedge, std::uint32_t i) { return std::floor(attribute.values[wedge][i] * factor + 0.5); });
}

VertexArray verticesOf(const Attribute& attribute) {
  const std::uint32_t components = attribute.type.components, bits = attribute.type.bits;
  switch (attribute.type.kind) {
  case AttributeKind::normal:
    return bits <= 8 ? copied<std::int8_t>(attribute, 4) : copied<std::int16_t>(attribute, 4);
  case AttributeKind::texCoord:
    return normalised<std::uint16_t>(attribute, 2);
  case AttributeKind::color: // GPUs read four bytes at once
    return bits <= 8 ? normalised<std::uint8_t>(attribute, 4) : normalised<std::uint16_t>(attribute, 4);
  case AttributeKind::other:
    break;
  }
  if (bits <= 8)
    return copied<std::uint8_t>(attribute, 4);
  if (bits <= 16)
    return copied<std::uint16_t>(attribute, components <= 2 ? 2 : 4);
  return copied<float>(attribute, components);
}

template <typename Index> ElementArray indexOf(const CompactPatch& patch) {
  ElementArray index = ElementArray::zeros<Index>(patch.corners.size());
  Index* to = index.as<Index>();
  if (patch.topology == Topology::triangles && patch.segmentCount == 0)
    orderForVertexCache(patch.corners, patch.fans, to);
  else
    for (const std::uint32_t wedge : patch.corners)
      *to++ = static_cast<Index>(wedge);
  return index;
}

} // namespace

template <typename T> ElementArray ElementArray::zeros(std::size_t length) {
  return {elementTypeOf<T>(), static_cast<std::uint32_t>(length), std::make_unique<std::byte[]>(length * sizeof(T))};
}

PatchBuffers buffersOf(CompactPatch patch) {
  PatchBuffers buffers;
  buffers.topology = patch.topology;
  buffers.positionBits = patch.positionBits;
  buffers.vertexCount = static_cast<std::uint32_t>(patch.wedgeCount());
  if (patch.topology != Topology::points)
    buffers.index =
        patch.wedgeCount() <= maxUint16VertexCount ? indexOf<std::uint16_t>(patch) : indexOf<std::uint32_t>(patch);
  buffers.coord = coordOf(patch);
  for (const Attribute& attribute : patch.attributes)
    buffers.attributes.push_back({attribute.type.kind, attribute.type.bits, verticesOf(attribute)});
  buffers.segments = std::move(patch.segments);
  buffers.segmentCount = patch.segmentCount;
  return buffers;
}

} // namespace imgeo::compact
