// verify(): reads a site back and compares it with the file that it was made from.

#include "imgeo/verify.h"

#include "base/box_corners.h"
#include "base/error.h"
#include "containers/order_by_file.h"
#include "documents/equal_geometries.h"
#include "documents/mixed_geometries.h"
#include "scene/shape_instances.h"
#include "scene/source_axes.h"
#include "transcode/node_geometry/open_whole_document.h"
#include "transcode/node_geometry/prepare_as.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"
#include "transcode/source/recordings.h"
#include "transcode/verify/check_files.h"
#include "transcode/verify/choose_comparison.h"
#include "transcode/verify/compare_animations.h"
#include "transcode/verify/compare_appearances.h"
#include "transcode/verify/compare_frames.h"
#include "transcode/verify/compare_geometry_nodes.h"
#include "transcode/verify/compare_instances.h"
#include "transcode/verify/compare_mapped.h"
#include "transcode/verify/compare_mesh.h"
#include "transcode/verify/compare_resampled.h"
#include "transcode/verify/compare_skins.h"
#include "transcode/verify/large_comparison.h"
#include "transcode/verify/prepare_input.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Whether two transforms map a mesh to the same positions, within the rounding of documents.
bool isSameTransform(const Affine3d& a, const Affine3d& b, const Box3d& box) {
  const double slack = transformSlack(b, box);
  return std::ranges::all_of(cornersOf(box),
                             [&](const Vec3d& corner) { return length(a.point(corner) - b.point(corner)) <= slack; });
}

/// Where all shapes are, in the site and in the input, whose coordinates become those of the document by
/// `documentFromInput`.
std::vector<ShapePair> pairsOf(const SceneGraph& site, const std::vector<ShapeInstance>& siteShapes, const Scene& input,
                               const std::vector<ShapeInstance>& inputShapes, const SceneMeshes& meshes,
                               const Affine3d& documentFromInput) {
  std::vector<ShapePair> pairs;
  for (std::size_t i = 0; i < siteShapes.size(); ++i) {
    ShapePair pair{shapeOf(site, siteShapes[i].node).mesh, shapeOf(input.graph, inputShapes[i].node).mesh,
                   siteShapes[i].worldFromShape, documentFromInput * inputShapes[i].worldFromShape};
    pair.hasSameTransform = isSameTransform(pair.worldFromSite, pair.worldFromInput, meshes.box(pair.mesh));
    pairs.push_back(pair);
  }
  return pairs;
}

/// What each shape of the site is. The input may have the coordinates of the source or, as exported GLB files have,
/// those of the document: those count in which fewer shapes stand elsewhere.
std::vector<ShapeMatch> matchShapes(const SceneGraph& site, const std::vector<ShapeInstance>& siteShapes,
                                    const Scene& input, const std::vector<ShapeInstance>& inputShapes,
                                    const SceneMeshes& meshes, const std::optional<SiteManifest>& manifest,
                                    VerifyReport& report) {
  const std::optional<double> stated = manifest ? manifest->instanceDistance : std::nullopt;
  const Affine3d documentFromInput = documentFromSource(manifest ? manifest->axes : SourceAxes{});
  const auto countMoved = [](const std::vector<ShapeMatch>& matches) {
    return std::ranges::count(matches, ShapeMatch::moved);
  };
  const auto match = [&](const Affine3d& map) {
    return matchShapes(pairsOf(site, siteShapes, input, inputShapes, meshes, map), meshes, stated, report);
  };
  std::vector<ShapeMatch> matches = match(documentFromInput);
  if (countMoved(matches) == 0 || documentFromInput == Affine3d{})
    return matches;
  const VerifyReport before = report;
  std::vector<ShapeMatch> others = match({});
  if (countMoved(others) < countMoved(matches))
    return others;
  report = before;
  return matches;
}

/// Names shapes in findings: by their own name, or by number and the nearest named node above.
class ShapeSubjects {
public:
  explicit ShapeSubjects(const SceneGraph& graph) : graph_(graph), parents_(graph.nodes.size()) {
    for (std::size_t node = 0; node < graph.nodes.size(); ++node)
      for (const std::size_t child : graph.nodes[node].children)
        parents_[child] = node;
  }

  /// `number`: of the shape in the document, from 0.
  std::string of(std::size_t shape, std::size_t number) const {
    if (const std::string& name = graph_.nodes[shape].name; !name.empty())
      return fmt::format("Shape \"{}\"", name);
    for (std::optional<std::size_t> node = parents_[shape]; node; node = parents_[*node])
      if (const std::string& name = graph_.nodes[*node].name; !name.empty())
        return fmt::format("Shape {} in \"{}\"", number + 1, name);
    return fmt::format("Shape {}", number + 1);
  }

private:
  const SceneGraph& graph_;
  std::vector<std::optional<std::size_t>> parents_; ///< by node: one that has it
};

/// Compares a mesh of the input with the geometry that has been made of it.
void compareGeometry(const ContainerReader& reader, GeometryDescription geometry, const SceneMeshes& meshes,
                     std::size_t mesh, LargeComparison* large, const std::optional<SiteManifest>& manifest,
                     VerifyReport& report, Findings& findings) {
  geometry.lattice = reader.latticeOf(geometry);
  if (large && large->isLarge(mesh))
    large->compare(mesh, reader, geometry, report, findings);
  else if (!geometry.operators.empty())
    compareMapped(reader, geometry, *meshes[mesh], report, findings);
  else if (geometry.surfaceDistance)
    compareResampled(reader, geometry, *meshes[mesh], manifest, report, findings);
  else
    compareMesh(reader, geometry, *meshes[mesh], manifest, report, findings);
}

/// A shape whose mesh is compared with its geometry.
struct ComparedShape {
  std::size_t node = 0, number = 0;   ///< in the site's graph, and among its shapes
  std::size_t geometry = 0, mesh = 0; ///< indices into those of the site and of the input
  std::vector<std::string> findings;
};

/// Calls compare(shape, geometry) for each shape, file by file, so that a file that many geometries share is decoded
/// once. The findings are in the order of `shapes`. An Error is one of them.
template <typename Compare>
void compareGeometries(const SceneDocument& site, std::vector<ComparedShape>& shapes, Compare compare,
                       VerifyReport& report, Findings& findings) {
  const ShapeSubjects subjects(site.graph);
  std::vector<std::size_t> indices(site.geometries.size());
  std::size_t index = 0;
  for (const std::size_t geometry : orderByFile(site.geometries))
    indices[geometry] = index++;
  std::vector<ComparedShape*> order;
  for (ComparedShape& shape : shapes)
    order.push_back(&shape);
  std::ranges::stable_sort(order, {}, [&](const ComparedShape* shape) { return indices.at(shape->geometry); });
  const std::vector<std::string> before = std::exchange(report.findings, {});
  for (ComparedShape* shape : order) {
    if (site.geometries.size() > 1)
      findings.setSubject(subjects.of(shape->node, shape->number));
    try {
      compare(*shape, site.geometries[shape->geometry]);
    } catch (const Error& error) {
      findings.add("{}.", error.what());
    }
    shape->findings = std::exchange(report.findings, {});
  }
  findings.setSubject("");
  report.findings = before;
  for (ComparedShape& shape : shapes)
    std::ranges::move(shape.findings, std::back_inserter(report.findings));
}

/// Compares the transform and material of every instance of a shape, and each mesh once.
/// Frames are compared elsewhere, and the meshes of sequences with them. `large`: compares meshes that memory does not
/// hold; null where it holds all.
void compareScenes(const SiteDocument& document, const Scene& input, const std::vector<Recording>& recordings,
                   LargeComparison* large, const std::optional<SiteManifest>& manifest, VerifyReport& report,
                   Findings& findings) {
  const SceneGraph& siteGraph = document.scene.graph;
  const std::vector<ShapeInstance> siteShapes = shapeInstances(siteGraph, (document.root / document.name).string()),
                                   inputShapes = shapeInstances(input.graph);
  if (siteShapes.size() != inputShapes.size())
    return findings.add("The site has {} shapes, the input {}.", siteShapes.size(), inputShapes.size());
  std::set<std::size_t> recorded;
  for (const Recording& recording : recordings)
    recorded.insert(shapeOf(input.graph, recording.shape).mesh);
  const ContainerReader reader(fetchFrom(document));
  std::set<std::pair<std::size_t, std::size_t>> compared;
  const SceneMeshes meshes(input.meshes, large ? large->stored() : nullptr);
  const std::vector<ShapeMatch> matches =
      matchShapes(siteGraph, siteShapes, input, inputShapes, meshes, manifest, report);
  std::vector<ComparedShape> shapes;
  std::size_t differentMaterials = 0, differentLighting = 0;
  for (std::size_t i = 0; i < siteShapes.size(); ++i) {
    const Shape &siteShape = shapeOf(siteGraph, siteShapes[i].node),
                &inputShape = shapeOf(input.graph, inputShapes[i].node);
    const std::size_t geometry = siteShape.mesh, mesh = inputShape.mesh;
    if (manifest && inputShape.appearance) {
      ++report.comparedMaterials;
      differentMaterials += !haveEqualAppearances(siteGraph, siteShape, input.graph, inputShape, input.meshes[mesh]);
    }
    if (report.isForeign && input.meshes[mesh].topology == Topology::triangles)
      differentLighting += isUnlit(siteGraph, siteGraph.nodes[siteShapes[i].node]).value_or(false) !=
                           isUnlit(input.graph, input.graph.nodes[inputShapes[i].node]).value_or(false);
    if (matches[i] != ShapeMatch::instance && compared.emplace(geometry, mesh).second && !recorded.contains(mesh))
      shapes.push_back({siteShapes[i].node, i, geometry, mesh, {}}); // of an instance matchShapes compared the mesh
  }
  compareGeometries(
      document.scene, shapes,
      [&](const ComparedShape& shape, const GeometryDescription& geometry) {
        compareGeometry(reader, geometry, meshes, shape.mesh, large, manifest, report, findings);
      },
      report, findings);
  if (const auto moved = std::ranges::count(matches, ShapeMatch::moved); moved > 0)
    findings.add("{} of {} shapes stand elsewhere than in the input.", moved, siteShapes.size());
  if (differentLighting > 0)
    findings.add("{} of {} shapes are lit in the site and not in the input, or the other way round.", differentLighting,
                 siteShapes.size());
  if (differentMaterials > 0)
    findings.add("{} of {} shapes have other materials than in the input, or other texture transforms.",
                 differentMaterials, report.comparedMaterials);
}

} // namespace

VerifyReport verify(const fs::path& site, const fs::path& input, const VerifyOptions& options) {
  VerifyReport report;
  Findings findings(report);
  SiteDocument document = openDocument(site);
  splitMixedGeometries(document.scene);
  const std::optional<SiteManifest> manifest = manifestOf(document);
  report.isForeign = !manifest;
  std::vector<Recording> recordings;
  std::optional<LargeComparison> large;
  if (std::optional<ChosenComparison> chosen = chooseComparison(document, manifest, site, input, options))
    large.emplace(std::move(*chosen), importOptionsFor(manifest, options.outside), *manifest,
                  workFolderOf(site, options), memoryLimit(options.memoryBytes));
  const Imported imported = large ? large->takeInput() : preparedInput(input, manifest, options.outside, recordings);
  // An X3D input has nodes as the site has them; any other has meshes of them.
  const bool areNodesMeshes = !imported.scene.graph.isComplete && !document.scene.geometryElements.empty();
  if (areNodesMeshes) {
    document = openWholeDocument(site);
    splitMixedGeometries(document.scene);
  }

  // An Error from a file of the site is a finding. Errors of the document, imgeo.json and the input are thrown.
  try {
    if (manifest) {
      checkDocuments(document, areNodesMeshes, findings);
      checkPictures(document, *manifest, findings);
    }
    shareEqualGeometries(document.scene);
    if (!imported.scene.graph.isComplete) // an X3D input may itself cause the warnings
      for (const std::string& warning : document.scene.warnings)
        findings.add("{}", warning);
    if (!areNodesMeshes)
      compareGeometryNodes(document, manifest.has_value(), imported.scene.graph, findings);
    for (const auto& [name, count] : areNodesMeshes ? document.scene.geometryElements : ElementsByName())
      findings.add("The site has {} {} {}, of which the input can have no mesh.", count, name,
                   count == 1 ? "node" : "nodes");
    if (manifest) {
      compareAnimations(document.scene, imported, *manifest, report);
      compareSkins(document.scene.graph, imported.scene.graph, findings);
    }
    if (checkFiles(document, report.isForeign, imported.scene.graph, findings)) {
      compareScenes(document, imported.scene, recordings, large ? &*large : nullptr, manifest, report, findings);
      compareRecordings(document, recordings, report, findings);
    }
  } catch (const WorkFault& fault) {
    throw fault.error;
  } catch (const Error& error) {
    findings.add("{}.", error.what());
  }
  report.equal = report.findings.empty();
  return report;
}

} // namespace imgeo
