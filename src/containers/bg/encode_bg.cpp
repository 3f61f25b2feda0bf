#include "containers/bg/bg.h"

#include "base/narrow.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// Appends the low bytes of an integer, as many as the type has.
void appendInteger(Bytes& out, ElementType type, std::int64_t value) {
  switch (byteSizeOf(type)) {
  case 1:
    return out.push_back(static_cast<std::uint8_t>(value));
  case 2:
    return appendLittle(out, static_cast<std::uint16_t>(value));
  default:
    return appendLittle(out, static_cast<std::uint32_t>(value));
  }
}

/// Appends a fraction: an integer type stores its product with the type's maximum, rounded; Float32 stores it as it is.
void appendFraction(Bytes& out, ElementType type, double fraction) {
  if (type == ElementType::float32)
    return appendLittle(out, static_cast<float>(fraction));
  const double clamped = std::clamp(fraction, isUnsigned(type) ? 0.0 : -1.0, 1.0);
  appendInteger(out, type, std::llround(clamped * maximumOf(type)));
}

/// The records of an attribute, each a multiple of four bytes long: GPUs require aligned records.
struct Column {
  Role role = Role::coord;
  Bytes bytes;
  std::uint32_t recordBytes = 0;
  bool isPadded = false;     ///< records are longer than their components
  std::size_t attribute = 0; ///< index in the geometry's attributes; Role::attribute only
};

Bytes indexArray(const IndexedPatch& patch, ElementType type) {
  Bytes out;
  out.reserve(patch.indices.size() * byteSizeOf(type));
  for (const std::uint32_t index : patch.indices)
    appendInteger(out, type, index);
  return out;
}

/// Whether normals of two bytes lie in the padding of 16-bit coordinates, where X3DOM expects spherical normals.
bool areNormalsInCoords(const IndexedPatch& patch, const GeometryDescription& geometry) {
  return !patch.normals.empty() && isPair(geometry.normalEncoding) &&
         geometry.attributeTypes[VertexRole::normal] == ElementType::uint8;
}

/// Coordinates of one or two bytes have a fourth element: X3DOM binds four elements if the stride allows it.
Column coordColumn(const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.coordType;
  const std::uint32_t size = byteSizeOf(type);
  Column column{Role::coord, {}, size < 4 ? 4 * size : 12, size < 4};
  column.bytes.reserve(patch.vertexCount() * column.recordBytes);
  if (type == ElementType::float32) {
    for (const Vec3u& q : patch.positions) {
      const Vec3f point(geometry.lattice.point(q));
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(column.bytes, point[axis]);
    }
    return column;
  }
  const StoredCoords stored = storedCoords(Encoding::bg, type, geometry.lattice.bits);
  const bool withNormals = areNormalsInCoords(patch, geometry);
  assert(!withNormals || size == 2);
  for (std::size_t n = 0; n < patch.vertexCount(); ++n) {
    for (int axis = 0; axis < 3; ++axis)
      appendInteger(column.bytes, type, storeCoord(patch.positions[n][axis], stored));
    const Vec2<std::uint32_t> pair =
        withNormals ? storeNormal(patch.normals[n], geometry.normalEncoding, 8) : Vec2<std::uint32_t>{};
    if (size < 4)
      appendInteger(column.bytes, type, pair.x | pair.y << 8);
  }
  return column;
}

Column normalColumn(const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.attributeTypes[VertexRole::normal];
  const std::uint32_t size = byteSizeOf(type);
  const bool isOfPairs = isPair(geometry.normalEncoding), isPadded = !isOfPairs && size < 4;
  Column column{Role::normal, {}, (isOfPairs ? 2 : isPadded ? 4 : 3) * size, isPadded};
  column.bytes.reserve(patch.vertexCount() * column.recordBytes);
  for (const Vec3f& normal : patch.normals) {
    if (isOfPairs) {
      const Vec2<std::uint32_t> pair = storeNormal(normal, geometry.normalEncoding, 8 * size);
      appendInteger(column.bytes, type, pair.x);
      appendInteger(column.bytes, type, pair.y);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
      appendFraction(column.bytes, type, normal[axis]);
    if (isPadded)
      appendInteger(column.bytes, type, 0);
  }
  return column;
}

Column texCoordColumn(VertexRole role, const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.attributeTypes[role];
  const std::size_t set = texCoordSetOf(role);
  const bool isPadded = byteSizeOf(type) == 1;
  Column column{fileRoleOf(role), {}, isPadded ? 4 : 2 * byteSizeOf(type), isPadded};
  column.bytes.reserve(patch.vertexCount() * column.recordBytes);
  for (const Vec2f& texCoord : texCoordsOf(patch, set)) {
    const Vec2<double> fraction = texCoordFraction(texCoord, geometry.texCoordBoxes[set]);
    appendFraction(column.bytes, type, fraction.x);
    appendFraction(column.bytes, type, fraction.y);
    if (isPadded)
      column.bytes.insert(column.bytes.end(), 2, 0);
  }
  return column;
}

/// Colours always have four elements, so that records of any type are aligned.
Column colorColumn(const IndexedPatch& patch, const GeometryDescription& geometry) {
  const ElementType type = geometry.attributeTypes[VertexRole::color];
  Column column{Role::color, {}, 4 * byteSizeOf(type), geometry.colorComponents == 3};
  column.bytes.reserve(patch.vertexCount() * column.recordBytes);
  for (const Rgba& color : patch.colors)
    for (const float channel : {color.r, color.g, color.b, color.a})
      appendFraction(column.bytes, type, channel);
  return column;
}

Column columnOf(VertexRole role, const IndexedPatch& patch, const GeometryDescription& geometry) {
  switch (role) {
  case VertexRole::normal:
    return normalColumn(patch, geometry);
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3:
    return texCoordColumn(role, patch, geometry);
  case VertexRole::color:
    break;
  }
  return colorColumn(patch, geometry);
}

Column attributeColumn(const NamedAttribute& attribute, std::size_t number) {
  Column column{Role::attribute, {}, 4 * attribute.components, false, number};
  column.bytes.reserve(4 * attribute.values.size());
  for (const float value : attribute.values)
    appendLittle(column.bytes, value);
  return column;
}

std::vector<Column> columnsOf(const IndexedPatch& patch, const GeometryDescription& geometry) {
  std::vector<Column> columns{coordColumn(patch, geometry)};
  for (const VertexRole role : vertexRoles)
    if (hasAttribute(patch, role) && (role != VertexRole::normal || !areNormalsInCoords(patch, geometry)))
      columns.push_back(columnOf(role, patch, geometry));
  for (std::size_t a = 0; a < geometry.attributes.size(); ++a)
    columns.push_back(attributeColumn(patch.namedAttributes.at(a), a));
  return columns;
}

/// Interleaves the records of all columns.
Bytes interleaved(const std::vector<Column>& columns, std::size_t count) {
  Bytes out;
  for (std::size_t n = 0; n < count; ++n)
    for (const Column& column : columns) {
      const auto record = column.bytes.begin() + static_cast<std::ptrdiff_t>(n * column.recordBytes);
      out.insert(out.end(), record, record + column.recordBytes);
    }
  return out;
}

} // namespace

EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry, Layout layout) {
  EncodedPatch encoded{.description = describePatch(patch, geometry)};
  if (!patch.indices.empty()) {
    const FileIndex file = addFile(encoded, {Role::index, ".bin", indexArray(patch, geometry.indexType)});
    encoded.references.push_back({Role::index, file, ByteLocation{}});
  }
  std::vector<Column> columns = columnsOf(patch, geometry);
  FileIndex coordFile{};
  ByteLocation coordLocation;
  const auto add = [&](const Column& column, FileIndex file, ByteLocation location) {
    encoded.references.push_back({column.role, file, location, column.attribute});
    if (column.role == Role::coord)
      coordFile = file, coordLocation = location;
  };
  if (layout == Layout::interleaved && columns.size() > 1) {
    const FileIndex file = addFile(encoded, {Role::coord, ".bin", interleaved(columns, patch.vertexCount())});
    ByteLocation location;
    for (const Column& column : columns)
      location.byteStride += column.recordBytes;
    for (const Column& column : columns) {
      add(column, file, location);
      location.byteOffset += column.recordBytes;
    }
  } else {
    for (Column& column : columns) {
      const FileIndex file = addFile(encoded, {column.role, ".bin", std::move(column.bytes)});
      // A stride is stated only if it is larger than the components.
      add(column, file, {.byteOffset = 0, .byteStride = column.isPadded ? column.recordBytes : 0});
    }
  }
  if (areNormalsInCoords(patch, geometry))
    encoded.references.push_back({Role::normal, coordFile, normalInCoords(coordLocation)});
  return encoded;
}

} // namespace imgeo
