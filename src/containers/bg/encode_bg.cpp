#include "containers/bg/bg.h"

#include "base/narrow.h"
#include "containers/stored.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

void appendUnsigned(Bytes& out, ElementType type, std::uint32_t value) {
  switch (byteSizeOf(type)) {
  case 1:
    return out.push_back(narrow<std::uint8_t>(value));
  case 2:
    return appendLittle(out, narrow<std::uint16_t>(value));
  default:
    return appendLittle(out, value);
  }
}

Bytes indexArray(const IndexedPatch& patch, ElementType type) {
  Bytes out;
  out.reserve(patch.indices.size() * byteSizeOf(type));
  for (const std::uint32_t index : patch.indices)
    appendUnsigned(out, type, index);
  return out;
}

/// Coordinates of one or two bytes get a fourth, 0: GPUs want records to begin
/// at whole words, and X3DOM binds four where the stride allows it.
Bytes coordArray(const IndexedPatch& patch, ElementType type, std::uint32_t shift) {
  Bytes out;
  out.reserve(patch.vertexCount() * 4 * byteSizeOf(type));
  for (const Vec3u& position : patch.positions) {
    for (int axis = 0; axis < 3; ++axis)
      appendUnsigned(out, type, storeCoord(position[axis], shift));
    if (byteSizeOf(type) < 4)
      appendUnsigned(out, type, 0);
  }
  return out;
}

Bytes normalArray(const IndexedPatch& patch, ElementType type) {
  Bytes out;
  out.reserve(patch.vertexCount() * 4 * byteSizeOf(type));
  const auto stored = [](float component, int maximum) {
    return std::lround(std::clamp(double{component}, -1.0, 1.0) * maximum);
  };
  for (const Vec3f& normal : patch.normals) {
    if (type == ElementType::float32) {
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(out, normal[axis]);
    } else if (type == ElementType::int16) {
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(out, static_cast<std::int16_t>(stored(normal[axis], 32767)));
      appendLittle(out, std::int16_t{0});
    } else {
      assert(type == ElementType::int8);
      for (int axis = 0; axis < 3; ++axis)
        out.push_back(static_cast<std::uint8_t>(stored(normal[axis], 127)));
      out.push_back(0);
    }
  }
  return out;
}

Bytes texCoordArray(const IndexedPatch& patch, const GeometryDescription& geometry) {
  Bytes out;
  out.reserve(patch.vertexCount() * 4);
  for (const Vec2f& texCoord : patch.texCoords) {
    if (geometry.texCoordType == ElementType::float32) {
      appendLittle(out, texCoord.x);
      appendLittle(out, texCoord.y);
      continue;
    }
    appendLittle(out, storeTexCoord(texCoord.x, geometry.texCoordMin.x, geometry.texCoordSize.x));
    appendLittle(out, storeTexCoord(texCoord.y, geometry.texCoordMin.y, geometry.texCoordSize.y));
  }
  return out;
}

Bytes colorArray(const IndexedPatch& patch) {
  Bytes out;
  out.reserve(patch.vertexCount() * 4);
  for (const Rgba8& color : patch.colors)
    out.insert(out.end(), {color.r, color.g, color.b, color.a});
  return out;
}

} // namespace

EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry) {
  assert((geometry.texCoordType == ElementType::uint16 || geometry.texCoordType == ElementType::float32) &&
         geometry.colorType == ElementType::uint8);
  EncodedPatch encoded{describePatch(patch, geometry), {}};
  PatchDescription& description = encoded.description;
  const auto add = [&](Role role, Bytes bytes, std::uint32_t stride) {
    Reference reference = addFile(encoded, {role, ".bin", std::move(bytes)});
    reference.stride = stride;
    return reference;
  };
  // A stride is stated only where it is more than the components take.
  const auto padded = [](ElementType type) { return byteSizeOf(type) < 4 ? 4 * byteSizeOf(type) : 0; };
  if (!patch.indices.empty())
    description.index = add(Role::index, indexArray(patch, geometry.indexType), 0);
  const std::uint32_t shift = coordShift(Container::bg, geometry.lattice.bits);
  description.coord = {
      add(Role::coord, coordArray(patch, geometry.coordType, shift), padded(geometry.coordType))};
  if (!patch.normals.empty())
    description.normal =
        add(Role::normal, normalArray(patch, geometry.normalType), padded(geometry.normalType));
  if (!patch.texCoords.empty())
    description.texCoord = add(Role::texCoord, texCoordArray(patch, geometry), 0);
  if (!patch.colors.empty())
    description.color = add(Role::color, colorArray(patch), geometry.colorComponents == 4 ? 0 : 4);
  return encoded;
}

} // namespace imgeo
