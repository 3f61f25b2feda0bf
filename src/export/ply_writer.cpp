// PLY, the Stanford polygon file format (Turk 1994), binary little-endian.

#include "base/error.h"
#include "base/narrow.h"
#include "export/export.h"

#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// What some shape has, and therefore every vertex; and what there is of each element.
struct Layout {
  bool normals = false, texCoords = false, colors = false, alpha = false;
  std::uint64_t vertices = 0, faces = 0, edges = 0;
};

Layout layoutOf(const Scene& scene) {
  Layout layout;
  for (const Shape& shape : scene.shapes) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    layout.normals |= !mesh.normals.empty();
    layout.texCoords |= !mesh.texCoords.empty();
    layout.colors |= !mesh.colors.empty();
    layout.alpha |= !mesh.colors.empty() && mesh.colorComponents == 4;
    layout.vertices += mesh.wedgeCount();
    if (mesh.topology == Topology::triangles)
      layout.faces += mesh.elementCount();
    if (mesh.topology == Topology::lines)
      layout.edges += mesh.elementCount();
  }
  return layout;
}

std::string headerOf(const Layout& layout) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  const auto properties = [&](const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names)
      header += fmt::format("property {} {}\n", type, name);
  };
  header += fmt::format("element vertex {}\n", layout.vertices);
  properties("float", {"x", "y", "z"});
  if (layout.normals)
    properties("float", {"nx", "ny", "nz"});
  if (layout.texCoords)
    properties("float", {"s", "t"});
  if (layout.colors)
    properties("uchar", {"red", "green", "blue"});
  if (layout.alpha)
    properties("uchar", {"alpha"});
  if (layout.faces > 0) {
    header += fmt::format("element face {}\n", layout.faces);
    properties("list uchar int", {"vertex_indices"});
  }
  if (layout.edges > 0) {
    header += fmt::format("element edge {}\n", layout.edges);
    properties("int", {"vertex1", "vertex2"});
  }
  return header + "end_header\n";
}

Rgba8 diffuseColorOf(const Material& material) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
  };
  return {byte(material.diffuseColor.x), byte(material.diffuseColor.y), byte(material.diffuseColor.z), 255};
}

void appendVertices(Bytes& out, const Shape& shape, const Mesh& mesh, const Layout& layout) {
  const Rgba8 plain = diffuseColorOf(shape.material);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const auto append = [&](Vec3f v) {
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(out, v[axis]);
    };
    append(mesh.positions[mesh.wedgePositions[wedge]]);
    if (layout.normals)
      append(mesh.normals.empty() ? Vec3f{} : mesh.normals[wedge]);
    if (layout.texCoords) {
      const Vec2f texCoord = mesh.texCoords.empty() ? Vec2f{} : mesh.texCoords[wedge];
      appendLittle(out, texCoord.x);
      appendLittle(out, texCoord.y);
    }
    if (layout.colors) {
      const Rgba8 color = mesh.colors.empty() ? plain : mesh.colors[wedge];
      out.insert(out.end(), {color.r, color.g, color.b});
      if (layout.alpha)
        out.push_back(color.a);
    }
  }
}

/// The corners of every mesh of one topology, counted through all shapes' vertices.
void appendElements(Bytes& out, const Scene& scene, Topology topology) {
  std::uint64_t firstVertex = 0;
  for (const Shape& shape : scene.shapes) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    if (mesh.topology == topology)
      for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
        if (topology == Topology::triangles && corner % 3 == 0)
          out.push_back(3);
        appendLittle(out, narrow<std::int32_t>(firstVertex + mesh.corners[corner]));
      }
    firstVertex += mesh.wedgeCount();
  }
}

} // namespace

Bytes writePly(const Scene& scene) {
  const Layout layout = layoutOf(scene);
  if (layout.vertices > INT32_MAX)
    throw Error(ErrorKind::limit, "",
                fmt::format("{} vertices are more than a PLY file can count", layout.vertices));
  const std::string header = headerOf(layout);
  Bytes out(header.begin(), header.end());
  for (const Shape& shape : scene.shapes)
    appendVertices(out, shape, scene.meshes[shape.mesh], layout);
  appendElements(out, scene, Topology::triangles);
  appendElements(out, scene, Topology::lines);
  return out;
}

} // namespace imgeo
