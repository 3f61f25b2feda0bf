#include "transcode/transform/transform_file.h"

#include "base/error.h"
#include "base/parallel.h"
#include "containers/stored_coords.h"
#include "export/export.h"
#include "import/x3d/node_table.h"
#include "transcode/export/write_scene.h"
#include "transcode/site/listed_elements.h"
#include "transcode/source/preparation.h"

#include <fmt/format.h>
#include <map>
#include <string>
#include <utility>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

std::vector<Operator> operatorsOf(const std::string& text, bool hasImages) {
  auto [operators, problem] = readOperators(text, hasImages);
  if (problem.empty() && operators.empty())
    problem = "names no operator";
  if (!problem.empty())
    throw Error(ErrorKind::usage, "--operators", problem);
  return operators;
}

/// Geometry nodes that no mesh has been made of: how many, by name.
std::map<std::string, std::size_t> geometryNodesOf(const SceneGraph& graph) {
  std::map<std::string, std::size_t> nodes;
  for (const std::size_t node : nodesInOrder(graph))
    if (const auto* generic = std::get_if<GenericNode>(&graph.nodes[node].content))
      if (const x3d::NodeRow* row = x3d::nodeRow(generic->element); row && row->containerField == "geometry")
        ++nodes[generic->element];
  return nodes;
}

/// The box in which a page of the converted mesh maps its vertices.
OperatorFrame frameOf(const Mesh& mesh) {
  const Box3d box = boxOf(mesh);
  const std::optional<DecodeFields> cube = quantizationCube(box);
  return cube ? OperatorFrame::of({cube->position - cube->size * 0.5, cube->position + cube->size * 0.5})
              : OperatorFrame::of(box);
}

} // namespace

TransformReport transformFile(const fs::path& input, const fs::path& output, const std::string& operators,
                              bool outside) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(), "ends in none of .ply, .obj and .glb, which say what to write");
  std::error_code ignored;
  if (fs::is_directory(input, ignored))
    return {exportSite(input, output, operatorsOf(operators, true)), {}};

  const std::vector<Operator> list = operatorsOf(operators, false);
  std::uint64_t bytes = 0;
  ImportOptions options;
  options.attributes.all = true;
  options.solids = true;
  options.outside = outside;
  Imported imported = importInput(input, options, bytes);
  Scene& scene = imported.scene;
  std::vector<bool> isEmpty;
  for (const Mesh& mesh : scene.meshes)
    isEmpty.push_back(mesh.elementCount() == 0);
  removeShapes(scene.graph, isEmpty);
  const std::vector<std::size_t> shapes = shapeNodes(scene.graph);
  const std::map<std::string, std::size_t> leftOut = geometryNodesOf(scene.graph);
  if (shapes.empty())
    throw Error(ErrorKind::malformed, locationOf(input),
                leftOut.empty() ? "holds no triangles, lines or points"
                                : fmt::format("holds no meshes, only nodes that are not mapped: {}", listed(leftOut)));
  parallelFor(scene.meshes.size(), [&](std::size_t i) {
    applyOperators(scene.meshes[i], list, frameOf(scene.meshes[i]), locationOf(input));
  });
  if (orientationOf(list) == Orientation::folded)
    for (const std::size_t node : shapes)
      std::get<Shape>(scene.graph.nodes[node].content).solid = false;
  TransformReport report{writeScene(scene, *format, output), std::move(imported.warnings)};
  if (*format == MeshFormat::glb)
    report.written.lightsLeftOut = lightsLeftOut(scene.graph);
  report.written.geometryLeftOut = leftOut;
  return report;
}

} // namespace imgeo
