#include "transcode/source/preparation.h"

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "prepare/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

struct MeshReport {
  WeldReport weld;
  bool normalsComputed = false;
  EdgeReport edges;
  double colorError = 0;
};

MeshReport prepareMesh(Mesh& mesh, const PreparationOptions& options) {
  MeshReport report;
  if (options.byteColors)
    report.colorError = roundColors(mesh);
  report.weld = weld(mesh, options.dropped);
  if (mesh.topology == Topology::triangles && mesh.normals.empty() && mesh.elementCount() > 0) {
    if (!mesh.creaseDegrees)
      mesh.creaseDegrees = guessCreases(isManMade(mesh), report.edges);
    report.edges.flat = options.flatWithoutNormals && mesh.creaseDegrees == 0;
    report.normalsComputed = report.edges.flat == 0;
    if (report.normalsComputed)
      computeNormals(mesh, options.weighting);
  }
  return report;
}

void addTo(WeldReport& sum, const WeldReport& one) {
  sum.mergedPositions += one.mergedPositions;
  sum.mergedWedges += one.mergedWedges;
  sum.unreferencedPositions += one.unreferencedPositions;
  sum.degenerateElements += one.degenerateElements;
  sum.duplicateElements += one.duplicateElements;
}

} // namespace

std::string locationOf(const std::filesystem::path& input) {
  return input == "-" ? "standard input" : input.string();
}

Imported importInput(const std::filesystem::path& input, const ImportOptions& options, std::uint64_t& bytes) {
  std::error_code fault; // importFile reports a file that cannot be read
  if (input == "-" || std::filesystem::is_fifo(input, fault)) {
    const Bytes read = readFile(input);
    bytes = read.size();
    return importBytes(read, locationOf(input), options);
  }
  const std::uintmax_t size = std::filesystem::file_size(input, fault);
  bytes = fault ? 0 : size;
  return importFile(input, options);
}

double roundColors(Mesh& mesh) {
  float change = 0;
  for (Rgba& color : mesh.colors) {
    const Rgba rounded = asRgba8(color);
    for (float Rgba::*channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a})
      change = std::max(change, std::abs(rounded.*channel - color.*channel));
    color = rounded;
  }
  if (std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color.a == 1; }))
    mesh.colorComponents = 3;
  return change;
}

PreparationOptions preparationFor(const ConvertOptions& options) {
  const bool isSampled = options.form == MeshForm::geometryImage || options.form == MeshForm::heightMap;
  return {.dropped = options.dropped,
          .weighting = options.normalWeighting,
          .flatWithoutNormals = options.target != Target::x3dom && !isSampled,
          .byteColors = options.colorBits <= 8};
}

PreparationReport prepareScene(Scene& scene, const PreparationOptions& options, const std::string& location) {
  std::vector<MeshReport> reports(scene.meshes.size());
  parallelFor(scene.meshes.size(), [&](std::size_t i) { reports[i] = prepareMesh(scene.meshes[i], options); });

  PreparationReport sum;
  for (const MeshReport& report : reports) {
    addTo(sum.weld, report.weld);
    sum.normalsComputed |= report.normalsComputed;
    sum.edges += report.edges;
    sum.colorError = std::max(sum.colorError, report.colorError);
  }
  const std::size_t shapesBefore = shapeNodes(scene.graph).size();
  std::vector<bool> isEmpty;
  for (const Mesh& mesh : scene.meshes)
    isEmpty.push_back(mesh.elementCount() == 0);
  removeShapes(scene.graph, isEmpty);
  const std::size_t shapesLeft = shapeNodes(scene.graph).size();
  if (shapesLeft == 0 && !scene.graph.isComplete)
    throw Error(ErrorKind::malformed, location, "holds no triangles, lines or points, so there is nothing to show");
  if (const std::size_t leftOut = shapesBefore - shapesLeft)
    sum.warnings.push_back(fmt::format("left out shapes without triangles, lines or points: {}", leftOut));
  return sum;
}

double guessCreases(bool isManMade, EdgeReport& guessed) {
  ++(isManMade ? guessed.guessedSharp : guessed.guessedSmooth);
  return isManMade ? manMadeCreaseDegrees : smoothDegrees;
}

LeftOutTexCoords keepFirstTexCoords(Scene& scene) {
  LeftOutTexCoords leftOut;
  for (const std::size_t node : shapeNodes(scene.graph)) {
    const Shape& shape = shapeOf(scene.graph, node);
    if (!shape.appearance)
      continue;
    leftOut.textures += std::erase_if(scene.graph.appearances[*shape.appearance].textures, [&](const TextureUse& use) {
      return texCoordSetNamed(use.mapping, scene.meshes[shape.mesh]) > 0;
    });
  }
  for (Mesh& mesh : scene.meshes) {
    leftOut.meshes += texCoordSetCount(mesh) > 1;
    for (std::size_t set = 1; set < maxTexCoordSets; ++set)
      texCoordsOf(mesh, set).clear();
    mesh.texCoordMappings.clear();
  }
  return leftOut;
}

} // namespace imgeo
