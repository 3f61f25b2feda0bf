// PLY, the Stanford polygon file format (Turk 1994), binary little-endian.

#include "base/error.h"
#include "base/narrow.h"
#include "export/export.h"
#include "export/world_shapes.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>

namespace imgeo {

namespace {

/// The properties of vertices, namely all that at least one shape has, and the number of elements of each kind.
struct PlyLayout {
  bool hasNormals = false, hasTexCoords = false, hasColors = false, hasAlpha = false;
  bool hasByteColors = true;                             ///< 8 bits hold every colour exactly
  std::map<std::string, std::uint32_t> componentsByName; ///< number of components of each further attribute
  std::uint64_t vertexCount = 0, faceCount = 0, edgeCount = 0;
};

/// Calls `visit` for the mesh of every instance of a shape, in local coordinates.
template <typename Visit> void forEachMesh(const Scene& scene, Visit visit) {
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    visit(scene.meshes[shapeOf(scene.graph, instance.node).mesh]);
}

PlyLayout layoutOf(const Scene& scene) {
  PlyLayout layout;
  forEachMesh(scene, [&](const Mesh& mesh) {
    layout.hasNormals |= !mesh.normals.empty();
    layout.hasTexCoords |= !mesh.texCoords.empty();
    layout.hasColors |= !mesh.colors.empty();
    layout.hasByteColors &= std::ranges::all_of(mesh.colors, isRgba8);
    layout.hasAlpha |= !mesh.colors.empty() && mesh.colorComponents == 4;
    for (const NamedAttribute& attribute : mesh.namedAttributes)
      layout.componentsByName.emplace(attribute.name, attribute.components);
    layout.vertexCount += mesh.wedgeCount();
    if (mesh.topology == Topology::triangles)
      layout.faceCount += mesh.elementCount();
    if (mesh.topology == Topology::lines)
      layout.edgeCount += mesh.elementCount();
  });
  return layout;
}

std::string headerOf(const PlyLayout& layout, std::optional<AxisDirection> up) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  if (up)
    header += fmt::format("comment up {}\n", nameOf(*up));
  const auto properties = [&](const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names)
      header += fmt::format("property {} {}\n", type, name);
  };
  header += fmt::format("element vertex {}\n", layout.vertexCount);
  properties("float", {"x", "y", "z"});
  if (layout.hasNormals)
    properties("float", {"nx", "ny", "nz"});
  if (layout.hasTexCoords)
    properties("float", {"s", "t"});
  if (layout.hasColors)
    properties(layout.hasByteColors ? "uchar" : "float", {"red", "green", "blue"});
  if (layout.hasAlpha)
    properties(layout.hasByteColors ? "uchar" : "float", {"alpha"});
  for (const auto& [name, components] : layout.componentsByName)
    for (std::uint32_t c = 0; c < components; ++c)
      header +=
          components == 1 ? fmt::format("property float {}\n", name) : fmt::format("property float {}_{}\n", name, c);
  if (layout.faceCount > 0) {
    header += fmt::format("element face {}\n", layout.faceCount);
    properties("list uchar int", {"vertex_indices"});
  }
  if (layout.edgeCount > 0) {
    header += fmt::format("element edge {}\n", layout.edgeCount);
    properties("int", {"vertex1", "vertex2"});
  }
  return header + "end_header\n";
}

Rgba diffuseColorOf(const Material& material) {
  const auto& [red, green, blue] = material.diffuseColor;
  return asRgba8(Rgba(red, green, blue, 1));
}

/// A component of a further attribute; 0 if the mesh has no attribute of this name and number of components.
float valueOf(const Mesh& mesh, const std::string& name, std::uint32_t components, std::size_t wedge,
              std::uint32_t component) {
  const auto found = std::ranges::find(mesh.namedAttributes, name, &NamedAttribute::name);
  const bool isPresent = found != mesh.namedAttributes.end() && found->components == components;
  return isPresent ? found->values[wedge * components + component] : 0;
}

void appendVertices(Bytes& out, const Appearance& appearance, const Mesh& mesh, const PlyLayout& layout) {
  const Rgba defaultColor = diffuseColorOf(phongOf(appearance.material));
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const auto append = [&](Vec3f v) {
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(out, v[axis]);
    };
    append(mesh.positions[mesh.wedgePositions[wedge]]);
    if (layout.hasNormals)
      append(mesh.normals.empty() ? Vec3f{} : mesh.normals[wedge]);
    if (layout.hasTexCoords) {
      const Vec2f texCoord = mesh.texCoords.empty() ? Vec2f{} : mesh.texCoords[wedge];
      appendLittle(out, texCoord.x);
      appendLittle(out, texCoord.y);
    }
    if (layout.hasColors) {
      const Rgba& color = mesh.colors.empty() ? defaultColor : mesh.colors[wedge];
      const Rgba8 bytes = asRgba8(color);
      const auto appendChannel = [&](std::uint8_t byte, float channel) {
        if (layout.hasByteColors)
          out.push_back(byte);
        else
          appendLittle(out, channel);
      };
      appendChannel(bytes.r, color.r);
      appendChannel(bytes.g, color.g);
      appendChannel(bytes.b, color.b);
      if (layout.hasAlpha)
        appendChannel(bytes.a, color.a);
    }
    for (const auto& [name, components] : layout.componentsByName)
      for (std::uint32_t c = 0; c < components; ++c)
        appendLittle(out, valueOf(mesh, name, components, wedge, c));
  }
}

/// Appends the vertex indices of a mesh's elements. `firstVertex`: index of the mesh's first vertex in the file.
void appendElements(Bytes& out, const Mesh& mesh, std::uint64_t firstVertex) {
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    if (mesh.topology == Topology::triangles && corner % 3 == 0)
      out.push_back(3);
    appendLittle(out, narrow<std::int32_t>(firstVertex + mesh.corners[corner]));
  }
}

} // namespace

Bytes writePly(const Scene& scene, std::optional<AxisDirection> up) {
  const PlyLayout layout = layoutOf(scene);
  if (layout.vertexCount > INT32_MAX)
    throw Error(ErrorKind::limit, "",
                fmt::format("{} vertices are more than a PLY file can count", layout.vertexCount));
  const std::string header = headerOf(layout, up);
  Bytes out(header.begin(), header.end()), faces, edges;
  std::uint64_t firstVertex = 0;
  forEachWorldShape(scene, [&](const std::string&, const Appearance& appearance, const Mesh& mesh) {
    appendVertices(out, appearance, mesh, layout);
    if (mesh.topology != Topology::points)
      appendElements(mesh.topology == Topology::triangles ? faces : edges, mesh, firstVertex);
    firstVertex += mesh.wedgeCount();
  });
  out.insert(out.end(), faces.begin(), faces.end());
  out.insert(out.end(), edges.begin(), edges.end());
  return out;
}

} // namespace imgeo
