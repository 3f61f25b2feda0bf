#include "import/x3d/sized_nodes.h"

#include "import/x3d/plane_geometry.h"
#include "import/x3d/solids.h"
#include "import/x3d/vertex_data_reader.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace imgeo::x3d {

namespace {

/// A node, and where its faces go.
struct SizedNode {
  const Source& source;
  pugi::xml_node node;
  VertexData& data;
  Faces& faces;

  double real(const char* field, double absent) const { return source.real(node, field, absent); }
  bool isTrue(const char* field) const { return source.boolean(node, field, true); }

  /// The first numbers of `size`; 2 each where it is absent.
  Vec3d size(std::size_t count) const {
    if (!node.attribute("size"))
      return {2, 2, 2};
    const std::vector<double> numbers = tuplesOf(source, node, "size", count);
    if (numbers.empty())
      source.fail(node, ErrorKind::malformed, "size is empty");
    return {numbers[0], numbers[1], count > 2 ? numbers[2] : 0};
  }

  Arc arc() const { return {real("radius", 1), real("startAngle", 0), real("endAngle", 1.570796)}; }
};

Topology addBoxNode(const SizedNode& node) {
  addBox(node.size(3), node.data, node.faces);
  return Topology::triangles;
}

Topology addSphereNode(const SizedNode& node) {
  addSphere(node.real("radius", 1), node.data, node.faces);
  return Topology::triangles;
}

Topology addCylinderNode(const SizedNode& node) {
  const double radius = node.real("radius", 1);
  addRoundSolid(
      {radius, radius, node.real("height", 2), node.isTrue("side"), node.isTrue("top"), node.isTrue("bottom")},
      node.data, node.faces);
  return Topology::triangles;
}

Topology addConeNode(const SizedNode& node) {
  addRoundSolid(
      {0, node.real("bottomRadius", 1), node.real("height", 2), node.isTrue("side"), false, node.isTrue("bottom")},
      node.data, node.faces);
  return Topology::triangles;
}

Topology addArcNode(const SizedNode& node) {
  addArc(node.arc(), node.data, node.faces);
  return Topology::lines;
}

Topology addClosedArcNode(const SizedNode& node) {
  std::string type = node.node.attribute("closureType").value();
  std::ranges::transform(type, type.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  addClosedArc(node.arc(), type == "CHORD", node.data, node.faces);
  return Topology::triangles;
}

Topology addCircleNode(const SizedNode& node) {
  addArc({node.real("radius", 1)}, node.data, node.faces);
  return Topology::lines;
}

Topology addDiskNode(const SizedNode& node) {
  const bool isSurface = addDisk(node.real("innerRadius", 0), node.real("outerRadius", 1), node.data, node.faces);
  return isSurface ? Topology::triangles : Topology::lines;
}

Topology addRectangleNode(const SizedNode& node) {
  const Vec3d size = node.size(2);
  addRectangle({size.x, size.y}, node.data, node.faces);
  return Topology::triangles;
}

using Adders = std::map<std::string_view, Topology (*)(const SizedNode&)>;

const Adders& adders() {
  static const Adders adders{{"Box", addBoxNode},         {"Sphere", addSphereNode}, {"Cylinder", addCylinderNode},
                             {"Cone", addConeNode},       {"Arc2D", addArcNode},     {"ArcClose2D", addClosedArcNode},
                             {"Circle2D", addCircleNode}, {"Disk2D", addDiskNode},   {"Rectangle2D", addRectangleNode}};
  return adders;
}

} // namespace

bool hasOnlySizes(std::string_view element) {
  return adders().contains(element);
}

Topology addSizedNode(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces) {
  return adders().at(node.name())({source, node, data, faces});
}

} // namespace imgeo::x3d
