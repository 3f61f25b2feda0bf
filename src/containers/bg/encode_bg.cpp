#include "containers/bg/bg.h"

#include "base/narrow.h"
#include "containers/normals.h"
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

/// Two bytes of normal fit into what pads a record of 16-bit coordinates to whole
/// words: X3DOM's place for spherical ones.
bool areNormalsInCoords(const IndexedPatch& patch, const GeometryDescription& geometry) {
  return !patch.normals.empty() && isPair(geometry.normalEncoding) &&
         geometry.normalType == ElementType::uint8;
}

/// Coordinates of one or two bytes get a fourth element: GPUs want records to begin
/// at whole words, and X3DOM binds four where the stride allows it.
Bytes coordArray(const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.coordType;
  const std::uint32_t shift = coordShift(Container::bg, geometry.lattice.bits);
  const bool withNormals = areNormalsInCoords(patch, geometry);
  assert(!withNormals || byteSizeOf(type) == 2);
  Bytes out;
  out.reserve(patch.vertexCount() * 4 * byteSizeOf(type));
  for (std::size_t n = 0; n < patch.vertexCount(); ++n) {
    for (int axis = 0; axis < 3; ++axis)
      appendUnsigned(out, type, storeCoord(patch.positions[n][axis], shift));
    if (withNormals) {
      const Vec2<std::uint32_t> stored = storeNormal(patch.normals[n], geometry.normalEncoding, 8);
      out.insert(out.end(), {narrow<std::uint8_t>(stored.x), narrow<std::uint8_t>(stored.y)});
    } else if (byteSizeOf(type) < 4) {
      appendUnsigned(out, type, 0);
    }
  }
  return out;
}

Bytes normalArray(const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.normalType;
  Bytes out;
  out.reserve(patch.vertexCount() * 4 * byteSizeOf(type));
  if (isPair(geometry.normalEncoding)) {
    for (const Vec3f& normal : patch.normals) {
      const Vec2<std::uint32_t> stored = storeNormal(normal, geometry.normalEncoding, 8 * byteSizeOf(type));
      appendUnsigned(out, type, stored.x);
      appendUnsigned(out, type, stored.y);
    }
    return out;
  }
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
  EncodedPatch encoded{describePatch(patch, geometry), {}, 0};
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
  description.coord = {add(Role::coord, coordArray(patch, geometry), padded(geometry.coordType))};
  if (areNormalsInCoords(patch, geometry))
    description.normal = normalInCoords(description.coord[0]);
  else if (isPair(geometry.normalEncoding) && !patch.normals.empty())
    description.normal = add(Role::normal, normalArray(patch, geometry), 0);
  else if (!patch.normals.empty())
    description.normal = add(Role::normal, normalArray(patch, geometry), padded(geometry.normalType));
  if (!patch.texCoords.empty())
    description.texCoord = add(Role::texCoord, texCoordArray(patch, geometry), 0);
  if (!patch.colors.empty())
    description.color = add(Role::color, colorArray(patch), geometry.colorComponents == 4 ? 0 : 4);
  return encoded;
}

} // namespace imgeo
