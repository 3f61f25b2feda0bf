#include "containers/compact/quantise.h"

#include "containers/compact/code_normals.h"
#include "containers/named_attributes.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"
#include "prepare/line_strips.h"
#include "prepare/primitives.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace imgeo::compact {

namespace {

AttributeType typeOf(AttributeKind kind, std::uint32_t components, std::uint32_t bits) {
  return {kind, static_cast<std::uint8_t>(components), static_cast<std::uint8_t>(bits), NormalMode::area};
}

/// Normals that differ less, in radians, are equal: they differ by the rounding of floats.
constexpr double exactNormalAngle = 1e-6;

/// The point of the octahedron in a direction, rounded as predictions are, so that floating-point and integer normals
/// of the same triangles give the same point.
Value quantiseNormal(const Vec3f& normal, std::uint32_t bits) {
  constexpr double fine = 1 << 24;
  const Vec3i64 direction{std::llround(normal.x * fine), std::llround(normal.y * fine), std::llround(normal.z * fine)};
  const std::int64_t radius = (std::int64_t{1} << (bits - 1)) - 1;
  return valueOf(octahedronPoint(direction, radius), radius);
}

std::int32_t quantiseFraction(double fraction, std::uint32_t bits) {
  const double steps = static_cast<double>((1u << bits) - 1);
  return static_cast<std::int32_t>(std::clamp(fraction, 0.0, 1.0) * steps + 0.5);
}

/// A quantised component as a fraction of its range.
double fractionOf(const Attribute& attribute, std::size_t wedge, std::uint32_t i) {
  return attribute.values[wedge][i] / static_cast<double>((1u << attribute.type.bits) - 1);
}

Attribute normalAttribute(const std::vector<Vec3f>& normals, const AttributeBits& bits) {
  Attribute attribute{typeOf(AttributeKind::normal, 3, bits.normal), {}};
  attribute.type.mode = bits.normalMode;
  attribute.values.reserve(normals.size());
  for (const Vec3f& normal : normals)
    attribute.values.push_back(quantiseNormal(normal, bits.normal));
  const auto isExact = [](const Vec3f& normal, const Value& value) {
    return angleBetween(normal, unitNormal(directionOf(value))) < exactNormalAngle;
  };
  if (!std::ranges::equal(normals, attribute.values, isExact))
    attribute.sourceNormals = normals;
  return attribute;
}

Attribute attributeOf(VertexRole role, const Patch& patch, const GeometryDescription& geometry,
                      const AttributeBits& bits) {
  switch (role) {
  case VertexRole::normal:
    return normalAttribute(patch.normals, bits);
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3:
    return texCoordAttribute(texCoordsOf(patch, texCoordSetOf(role)), geometry.texCoordBoxes[texCoordSetOf(role)],
                             bits.texCoord);
  case VertexRole::color:
    break;
  }
  return colorAttribute(patch.colors, geometry.colorComponents, bits.color);
}

NamedAttribute namedOf(const Attribute& attribute, const AttributeDescription& description) {
  NamedAttribute named{description.name, description.components, {}};
  for (const Value& value : attribute.values)
    for (std::uint32_t i = 0; i < description.components; ++i)
      named.values.push_back(loadNumber(static_cast<std::uint32_t>(value[i]), description, i));
  return named;
}

CompactPatch quantiseInOrder(Patch patch, const GeometryDescription& geometry, const AttributeBits& bits) {
  CompactPatch quantised;
  quantised.topology = patch.topology;
  quantised.positionBits = geometry.lattice.bits;
  quantised.positions = std::move(patch.positions);
  quantised.wedgePositions = std::move(patch.wedgePositions);
  quantised.corners = std::move(patch.corners);
  quantised.grid = patch.grid;
  for (const VertexRole role : vertexRoles)
    if (hasAttribute(patch, role))
      quantised.attributes.push_back(attributeOf(role, patch, geometry, bits));
  for (std::size_t i = 0; i < patch.namedAttributes.size(); ++i) {
    const AttributeDescription& description = geometry.attributes.at(i);
    quantised.attributes.push_back(namedAttribute(patch.namedAttributes[i], description, 8 * description.bytes));
  }
  return quantised;
}

/// Gives every wedge of a point cloud its own position, in Morton order.
Patch separatePoints(const Patch& patch) {
  const std::vector<std::uint32_t> order = mortonOrder(patch);
  Patch points;
  static_cast<VertexAttributes&>(points) = gather(patch, order);
  points.topology = Topology::points;
  points.positions = gather(patch.positions, gather(patch.wedgePositions, order));
  points.wedgePositions.resize(order.size());
  std::iota(points.wedgePositions.begin(), points.wedgePositions.end(), 0u);
  points.corners = points.wedgePositions;
  return points;
}

/// The corners of lines along trails (prepare/line_strips.h).
std::vector<std::uint32_t> alongTrails(const Patch& patch) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t corner : findLineStrips(patch.corners, patch.wedgeCount()).corners)
    corners.insert(corners.end(), {patch.corners[corner], patch.corners[corner ^ 1]});
  return corners;
}

Primitive primitiveOf(Topology topology) {
  return topology == Topology::triangles ? Primitive::triangles
         : topology == Topology::lines   ? Primitive::lines
                                         : Primitive::points;
}

} // namespace

Attribute texCoordAttribute(const std::vector<Vec2f>& texCoords, const TexCoordBox& box, std::uint32_t bits) {
  Attribute attribute{typeOf(AttributeKind::texCoord, 2, bits), {}};
  for (const Vec2f& texCoord : texCoords) {
    const Vec2<double> fraction = texCoordFraction(texCoord, box);
    attribute.values.push_back({{quantiseFraction(fraction.x, bits), quantiseFraction(fraction.y, bits)}});
  }
  return attribute;
}

Attribute colorAttribute(const std::vector<Rgba>& colors, std::uint32_t components, std::uint32_t bits) {
  Attribute attribute{typeOf(AttributeKind::color, components, bits), {}};
  for (const Rgba& color : colors) {
    Value value{{quantiseFraction(color.r, bits), quantiseFraction(color.g, bits), quantiseFraction(color.b, bits)}};
    if (components == 4)
      value[3] = quantiseFraction(color.a, bits);
    attribute.values.push_back(value);
  }
  return attribute;
}

Attribute namedAttribute(const NamedAttribute& named, const AttributeDescription& description, std::uint32_t bits) {
  Attribute attribute{typeOf(AttributeKind::other, named.components, bits), {}};
  const std::uint32_t whole = 8 * description.bytes;
  for (std::size_t wedge = 0; wedge < named.count(); ++wedge) {
    Value value;
    for (std::uint32_t i = 0; i < named.components; ++i) {
      const std::uint32_t stored = storeNumber(named.values[wedge * named.components + i], description, i);
      value[i] = bits == whole ? static_cast<std::int32_t>(stored)
                               : quantiseFraction(stored / static_cast<double>((1u << whole) - 1), bits);
    }
    attribute.values.push_back(value);
  }
  return attribute;
}

std::vector<Draw> drawsOf(const CompactPatch& patch) {
  return {{primitiveOf(patch.topology), static_cast<std::uint32_t>(patch.corners.size())}};
}

CompactPatch quantise(Patch patch, const GeometryDescription& geometry, const AttributeBits& bits) {
  if (patch.topology == Topology::points)
    return quantiseInOrder(separatePoints(patch), geometry, bits);
  if (patch.topology == Topology::lines)
    patch.corners = alongTrails(patch);
  return quantiseInOrder(std::move(patch), geometry, bits);
}

IndexedPatch verticesOf(const CompactPatch& patch, const GeometryDescription& geometry) {
  IndexedPatch vertices;
  vertices.colorComponents = geometry.colorComponents;
  for (const std::uint32_t position : patch.wedgePositions)
    vertices.positions.push_back(patch.positions[position]);
  RoleCounter roles;
  for (const Attribute& attribute : patch.attributes) {
    const std::optional<VertexRole> role = roles.next(attribute.type.kind);
    if (attribute.type.kind == AttributeKind::other)
      vertices.namedAttributes.push_back(namedOf(attribute, geometry.attributes.at(vertices.namedAttributes.size())));
    for (std::size_t wedge = 0; wedge < patch.wedgeCount(); ++wedge) {
      const Value& value = attribute.values[wedge];
      switch (attribute.type.kind) {
      case AttributeKind::normal:
        vertices.normals.push_back(unitNormal(directionOf(value)));
        break;
      case AttributeKind::texCoord: {
        const std::size_t set = texCoordSetOf(role.value());
        texCoordsOf(vertices, set)
            .push_back(texCoordAt({fractionOf(attribute, wedge, 0), fractionOf(attribute, wedge, 1)},
                                  geometry.texCoordBoxes[set]));
        break;
      }
      case AttributeKind::color: {
        const auto at = [&](std::uint32_t i) { return static_cast<float>(fractionOf(attribute, wedge, i)); };
        vertices.colors.emplace_back(at(0), at(1), at(2), attribute.type.components == 4 ? at(3) : 1);
        break;
      }
      case AttributeKind::other:
        break;
      }
    }
  }
  if (patch.topology != Topology::points)
    vertices.indices = patch.corners;
  vertices.draws = drawsOf(patch);
  return vertices;
}

} // namespace imgeo::compact
