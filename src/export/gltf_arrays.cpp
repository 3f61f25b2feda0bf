#include "export/gltf_arrays.h"

#include "export/gltf_deformation.h"
#include "scene/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace imgeo {

namespace {

// Constants of glTF, named as in its specification.
constexpr int elementArrayBuffer = 34963, unsignedInt = 5125;

std::size_t addPositions(GltfArrays& arrays, const Mesh& mesh) {
  Vec3f min = mesh.positions[mesh.wedgePositions[0]], max = min;
  arrays.begin();
  for (const std::uint32_t position : mesh.wedgePositions)
    for (int axis = 0; axis < 3; ++axis) {
      const float value = mesh.positions[position][axis];
      min[axis] = std::min(min[axis], value);
      max[axis] = std::max(max[axis], value);
      appendLittle(arrays.bytes, value);
    }
  const std::size_t accessor = arrays.end(arrayBuffer, floatType, "VEC3", mesh.wedgeCount());
  arrays.accessors.back()["min"] = {min.x, min.y, min.z};
  arrays.accessors.back()["max"] = {max.x, max.y, max.z};
  return accessor;
}

std::size_t addNormals(GltfArrays& arrays, const Mesh& mesh) {
  arrays.begin();
  for (const Vec3f& normal : mesh.normals)
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(arrays.bytes, normal[axis]);
  return arrays.end(arrayBuffer, floatType, "VEC3", mesh.wedgeCount());
}

std::size_t addTexCoords(GltfArrays& arrays, const std::vector<Vec2f>& texCoords) {
  arrays.begin();
  for (const Vec2f& texCoord : texCoords) {
    appendLittle(arrays.bytes, texCoord.x);
    appendLittle(arrays.bytes, 1 - texCoord.y); // in glTF the origin is the upper left corner of an image
  }
  return arrays.end(arrayBuffer, floatType, "VEC2", texCoords.size());
}

std::size_t addColors(GltfArrays& arrays, const Mesh& mesh) {
  const auto append = [&](double fraction) {
    appendLittle(arrays.bytes, static_cast<std::uint16_t>(std::lround(65535 * fraction)));
  };
  arrays.begin();
  for (const Rgba& color : mesh.colors) {
    for (const float channel : {color.r, color.g, color.b})
      append(linearOfSrgb(channel));
    append(color.a); // already linear
  }
  const std::size_t accessor = arrays.end(arrayBuffer, unsignedShort, "VEC4", mesh.wedgeCount());
  arrays.accessors.back()["normalized"] = true;
  return accessor;
}

std::size_t addAttribute(GltfArrays& arrays, const Mesh& mesh, VertexRole role) {
  switch (role) {
  case VertexRole::normal:
    return addNormals(arrays, mesh);
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3:
    return addTexCoords(arrays, texCoordsOf(mesh, texCoordSetOf(role)));
  case VertexRole::color:
    break;
  }
  return addColors(arrays, mesh);
}

std::size_t addNamedAttribute(GltfArrays& arrays, const NamedAttribute& attribute) {
  constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  arrays.begin();
  for (const float value : attribute.values)
    appendLittle(arrays.bytes, value);
  return arrays.end(arrayBuffer, floatType, types[attribute.components - 1], attribute.count());
}

/// Adds indices of 16 bits if there are at most 65,535 vertices, of 32 bits otherwise. The 16-bit index 65,535 would
/// restart primitives.
std::size_t addIndices(GltfArrays& arrays, const Mesh& mesh) {
  const bool are16Bit = mesh.wedgeCount() <= 65535;
  arrays.begin();
  for (const std::uint32_t corner : mesh.corners) {
    if (are16Bit)
      appendLittle(arrays.bytes, static_cast<std::uint16_t>(corner));
    else
      appendLittle(arrays.bytes, corner);
  }
  return arrays.end(elementArrayBuffer, are16Bit ? unsignedShort : unsignedInt, "SCALAR", mesh.corners.size());
}

} // namespace

Json gltfPrimitive(GltfArrays& arrays, const Mesh& mesh) {
  Json attributes{{"POSITION", addPositions(arrays, mesh)}};
  visitAttributes(mesh, [&](const auto& row, const auto& values) {
    if (!values.empty())
      attributes[row.gltfName] = addAttribute(arrays, mesh, row.role);
  });
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    if (!isOfDeformation(attribute.name))
      attributes["_" + attribute.name] = addNamedAttribute(arrays, attribute);
  constexpr int modes[] = {0, 1, 4}; // POINTS, LINES, TRIANGLES
  Json primitive{{"attributes", attributes},
                 {"indices", addIndices(arrays, mesh)},
                 {"mode", modes[cornersPerElement(mesh.topology) - 1]}};
  addDeformation(arrays, mesh, primitive);
  return primitive;
}

} // namespace imgeo
