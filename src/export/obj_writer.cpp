// Wavefront OBJ (Wavefront Technologies, Advanced Visualizer manual, appendix B1).

#include "export/export.h"
#include "export/world_shapes.h"

#include <bit>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <tuple>

namespace imgeo {

namespace {

using Text = fmt::memory_buffer;

template <typename... Values> void print(Text& out, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Values>(values)...);
}

/// The `v` lines of a shape: their number, and the index of each wedge's line, from 0.
struct PositionLines {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> ofWedge;
};

PositionLines printPositions(Text& out, const Mesh& mesh) {
  PositionLines written{mesh.positions.size(), {mesh.wedgePositions.begin(), mesh.wedgePositions.end()}};
  if (mesh.colors.empty()) {
    for (const Vec3f& p : mesh.positions)
      print(out, "v {} {} {}\n", p.x, p.y, p.z);
    return written;
  }
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint64_t> lines;
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const Rgba& color = mesh.colors[wedge];
    const auto [line, isNew] = lines.try_emplace({mesh.wedgePositions[wedge], color.r, color.g, color.b}, lines.size());
    written.ofWedge[wedge] = line->second;
    if (!isNew)
      continue;
    const Vec3f& p = mesh.positions[mesh.wedgePositions[wedge]];
    const int digits = isRgba8(color) ? 6 : 9; // nine are all of single precision
    print(out, "v {} {} {} {:.{}g} {:.{}g} {:.{}g}\n", p.x, p.y, p.z, color.r, digits, color.g, digits, color.b,
          digits);
  }
  written.count = lines.size();
  return written;
}

/// Number of lines of each kind before those of a shape.
struct LinesBefore {
  std::uint64_t positions = 0, texCoords = 0, normals = 0;
};

void printElements(Text& out, const Mesh& mesh, const PositionLines& positions, LinesBefore before) {
  const std::uint32_t perElement = cornersPerElement(mesh.topology);
  const bool texCoords = !mesh.texCoords.empty() && mesh.topology != Topology::points;
  const bool normals = !mesh.normals.empty() && mesh.topology == Topology::triangles;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    const std::uint32_t wedge = mesh.corners[corner];
    if (corner % perElement == 0)
      out.push_back("plf"[perElement - 1]);
    print(out, " {}", before.positions + positions.ofWedge[wedge] + 1);
    if (texCoords)
      print(out, "/{}", before.texCoords + wedge + 1);
    if (normals)
      print(out, "{}{}", texCoords ? "/" : "//", before.normals + wedge + 1);
    if (corner % perElement == perElement - 1)
      out.push_back('\n');
  }
}

/// A name without control characters, which would end its line.
std::string oneLine(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ')
      c = ' ';
  return name;
}

} // namespace

Bytes writeObj(const Scene& scene) {
  Text out;
  LinesBefore before;
  std::size_t shapes = 0;
  forEachWorldShape(scene, [&](const std::string& name, const Appearance&, const Mesh& mesh) {
    ++shapes;
    print(out, "o {}\n", name.empty() ? fmt::format("shape{}", shapes) : oneLine(name));
    const PositionLines positions = printPositions(out, mesh);
    for (const Vec2f& t : mesh.texCoords)
      print(out, "vt {} {}\n", t.x, t.y);
    for (const Vec3f& n : mesh.normals)
      print(out, "vn {} {} {}\n", n.x, n.y, n.z);
    printElements(out, mesh, positions, before);
    before.positions += positions.count;
    before.texCoords += mesh.texCoords.size();
    before.normals += mesh.normals.size();
  });
  return Bytes(out.begin(), out.end());
}

} // namespace imgeo
