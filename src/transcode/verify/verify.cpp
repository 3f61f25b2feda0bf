// Reads a site back and compares it with the file that it was made from.

#include "imgeo/verify.h"
#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/patches.h"
#include "scene/shape_instances.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_files.h"
#include "transcode/site/site_manifest.h"
#include "transcode/source/preparation.h"
#include "transcode/verify/compare_appearances.h"
#include "transcode/verify/element_list.h"
#include "transcode/verify/foreign_site.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Reports one sentence for each thing that is wrong.
class Findings {
public:
  explicit Findings(VerifyReport& report) : report_(report) {}
  template <typename... Arguments> void add(fmt::format_string<Arguments...> sentence, Arguments&&... arguments) {
    report_.findings.push_back(fmt::format(sentence, std::forward<Arguments>(arguments)...));
  }

private:
  VerifyReport& report_;
};

/// The bound of a palette and of compact is what convert says; it need not hold for other sites.
double normalBoundDegrees(const GeometryDescription& geometry, const SiteManifest& manifest) {
  const bool isStated = geometry.normalEncoding == NormalEncoding::palette || rowOf(geometry).hasMeasuredNormalError;
  const double bound = isStated ? manifest.normalErrorDegrees : normalErrorBound(geometry) * (180 / std::numbers::pi);
  return std::max(bound, 1e-5);
}

/// Of images any type but Float32: their lattice is exact.
ElementType coordTypeOf(const GeometryDescription& geometry) {
  return hasElementTypes(geometry.encoding) ? geometry.coordType : ElementType::uint32;
}

/// Brings colours to those that fewer than 8 bits a component can tell apart.
void roundColors(std::vector<Rgba8>& colors, std::uint32_t bits) {
  if (bits == 0 || bits >= 8)
    return;
  const double steps = (1 << bits) - 1;
  for (Rgba8& color : colors)
    for (std::uint8_t* component : {&color.r, &color.g, &color.b, &color.a})
      *component = static_cast<std::uint8_t>(std::floor(*component / 255.0 * steps + 0.5) / steps * 255 + 0.5);
}

/// By how much each component of the further attributes may be off.
std::map<std::string, std::vector<double>> namedBounds(const GeometryDescription& geometry) {
  std::map<std::string, std::vector<double>> bounds;
  for (const AttributeDescription& attribute : geometry.attributes)
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      bounds[attribute.name].push_back(numberBound(geometry.encoding, attribute, c));
  return bounds;
}

/// Every file that the page names is there and, in our sites, holds what its name says.
bool checkFiles(const SiteDocument& document, bool isForeign, const SceneGraph& input, Findings& findings) {
  bool whole = true;
  std::vector<std::string> urls = isForeign ? std::vector<std::string>{} : pageFilesOf(document);
  for (const InlinedDocument& inlined : document.scene.graph.inlined)
    urls.push_back(inlined.url);
  const std::set<std::string> left = texturesLeftIn(input);
  for (const std::string& url : textureFilesOf(document.scene))
    if (!left.contains(url))
      urls.push_back(url);
  for (const std::string& url : previewFilesOf(document.scene))
    urls.push_back(url);
  for (const NamedFile& file : geometryFilesOf(document.scene))
    urls.push_back(file.url);
  for (const std::string& url : urls) {
    const fs::path file = fileOf(document, url);
    std::error_code none;
    if (!fs::is_regular_file(file, none)) {
      findings.add("{} is named by the document but is not there.", url);
      whole = false;
      continue;
    }
    if (isForeign || file.extension() == ".css")
      continue;
    const std::string stem = file.stem(), content = contentName(readFile(file));
    if (!stem.ends_with(content))
      findings.add("{} does not hold what its name says (its content is {}).", url, content);
  }
  return whole;
}

/// The page and scene.x3d say the same.
void checkDocuments(const SiteDocument& page, Findings& findings) {
  if (page.name == sceneName)
    return;
  const SiteDocument scene = openDocument(page.root / sceneName);
  if (writeX3d(scene.scene) != writeX3d(page.scene))
    findings.add("{} and {} differ.", pageName, sceneName);
}

std::vector<IndexedPatch> decodePatches(const ContainerReader& reader, const GeometryDescription& geometry) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = reader.decode(geometry.patches[i], geometry); });
  return patches;
}

/// Every patch lies in the box that the document gives it, if it gives one.
void checkBoxes(const std::vector<IndexedPatch>& patches, const GeometryDescription& geometry, Findings& findings) {
  const double slack = geometry.lattice.step / 2 + 1e-6 * geometry.box.longestEdge();
  const auto agree = [&](const Box3d& a, const Box3d& b) {
    for (int axis = 0; axis < 3 && !b.empty(); ++axis)
      if (!(std::abs(a.min[axis] - b.min[axis]) <= slack && std::abs(a.max[axis] - b.max[axis]) <= slack))
        return false;
    return true;
  };
  Box3d whole;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Box3d box;
    for (const Vec3u q : patches[i].positions)
      box.add(geometry.lattice.point(q));
    wrong += !agree(box, geometry.patches[i].box);
    whole.add(box.min);
    whole.add(box.max);
  }
  if (wrong > 0)
    findings.add("{} of {} patches have a box that does not fit their vertices.", wrong, patches.size());
  if (!agree(whole, geometry.box))
    findings.add("The box of the geometry does not fit its vertices.");
}

/// The largest distance an axis between where the input has a vertex and where
/// the site's document puts the lattice point that stands for it.
double positionError(const Mesh& mesh, const std::vector<Vec3u>& quantised, const Lattice& lattice) {
  double error = 0;
  for (std::size_t i = 0; i < quantised.size(); ++i) {
    const Vec3d off = lattice.point(quantised[i]) - Vec3d(mesh.positions[i]);
    error = std::max({error, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  }
  return error;
}

/// Rounding in double precision, which counts where the step is near it: far from
/// the origin, with 32 bits.
double positionTolerance(const Mesh& mesh, const Lattice& lattice) {
  const Box3d box = boxOf(mesh);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return 1e-6 * lattice.step + 8 * largest * std::numeric_limits<double>::epsilon();
}

void checkAttributesPresent(const Mesh& mesh, const std::vector<IndexedPatch>& patches, Findings& findings) {
  const auto check = [&](const char* what, bool inInput, auto member) {
    for (const IndexedPatch& patch : patches)
      if ((patch.*member).empty() == inInput && patch.vertexCount() > 0)
        return findings.add("The {} {} {}.", inInput ? "input has" : "site has", what,
                            inInput ? "that the site lacks" : "that the input lacks");
  };
  check("normals", !mesh.normals.empty(), &IndexedPatch::normals);
  check("texture coordinates", !mesh.texCoords.empty(), &IndexedPatch::texCoords);
  check("colours", !mesh.colors.empty(), &IndexedPatch::colors);
  const auto namesOf = [](const VertexAttributes& attributes) {
    std::set<std::string> names;
    for (const NamedAttribute& attribute : attributes.namedAttributes)
      names.insert(fmt::format("\"{}\" of {}", attribute.name, attribute.components));
    return names;
  };
  for (const IndexedPatch& patch : patches)
    if (namesOf(patch) != namesOf(mesh))
      return findings.add("The input's further attributes are {}, the site's {}.", fmt::join(namesOf(mesh), ", "),
                          fmt::join(namesOf(patch), ", "));
}

void count(const ElementDifference& difference, const ElementList& input, const ElementList& site, Topology topology,
           VerifyReport& report) {
  report.input.of(topology) += input.elements.size();
  report.site.of(topology) += site.elements.size();
  report.missing.of(topology) += difference.missing;
  report.extra.of(topology) += difference.extra;
}

/// Whether two maps put a mesh to the same place, but for how documents round.
bool agree(const Affine3d& a, const Affine3d& b, const Box3d& box) {
  const double slack = 1e-6 * (length(b.direction(box.size())) + length(b.point(box.center())));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d point{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z};
    if (!(length(a.point(point) - b.point(point)) <= slack))
      return false;
  }
  return true;
}

/// Where the vertices of the input are on the site's lattice.
std::vector<Vec3u> quantisedAs(const GeometryDescription& geometry, const std::vector<IndexedPatch>& patches,
                               const Mesh& mesh, bool isForeign) {
  if (isForeign)
    return quantiseLike(patches, mesh.positions, geometry.lattice);
  const Lattice expected = latticeFor(boxOf(mesh), coordTypeOf(geometry), geometry.lattice.bits);
  std::vector<Vec3u> quantised = quantise(mesh.positions, expected);
  for (Vec3u& q : quantised)
    q = pointReadBack(q, expected, geometry);
  return quantised;
}

void checkPositions(const GeometryDescription& geometry, const std::vector<Vec3u>& quantised, const Mesh& mesh,
                    VerifyReport& report, Findings& findings) {
  const double error = positionError(mesh, quantised, geometry.lattice),
               slack = report.isForeign ? foreignRounding * geometry.lattice.step : 0,
               bound = positionErrorBound(geometry) + slack;
  if (error * report.positionBound >= report.positionError * bound)
    report.positionError = error, report.positionBound = bound;
  if (error > bound + positionTolerance(mesh, geometry.lattice))
    findings.add("Positions are off by up to {:.6g}, more than half a step of the lattice, {:.6g}.", error, bound);
}

/// The base, if there is one, must be whole and leave no crack beside any patch.
void checkBase(const ContainerReader& reader, const GeometryDescription& geometry,
               const std::vector<IndexedPatch>& patches, Findings& findings) {
  if (!geometry.base)
    return;
  const BaseMesh base = reader.decodeBase(geometry);
  std::vector<PatchTriangles> triangles;
  for (const IndexedPatch& patch : patches)
    triangles.push_back({patch.positions, patch.indices});
  if (!meetsAtBorders(base, triangles))
    findings.add("The base does not meet the patches at their borders.");
}

void compareMesh(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                 const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings) {
  std::vector<IndexedPatch> patches = decodePatches(reader, geometry);
  checkBoxes(patches, geometry, findings);
  checkBase(reader, geometry, patches, findings);
  if (!manifest && mesh.normals.empty())
    for (IndexedPatch& patch : patches)
      patch.normals.clear(); // computed, who knows how
  checkAttributesPresent(mesh, patches, findings);
  const std::vector<Vec3u> quantised = quantisedAs(geometry, patches, mesh, !manifest);
  checkPositions(geometry, quantised, mesh, report, findings);

  const Topology topology = manifest ? manifest->primitives == Primitives::points ? Topology::points : mesh.topology
                                     : topologyOf(patches.front().draws.front().primitive);
  const bool isWithoutIndex = std::ranges::any_of(patches, &std::vector<std::uint32_t>::empty, &IndexedPatch::indices);
  const ElementKind kind{topology, isWithoutIndex};
  ElementList input = elementsOf(mesh, quantised, kind);
  const ElementList site = elementsOf(patches, kind);
  const StoredPrecision precision = reader.precisionOf(geometry);
  roundColors(input.colors, precision.colorBits);
  const AttributeBounds bounds{normalBoundDegrees(geometry, manifest.value_or(SiteManifest{})),
                               texCoordErrorBound(geometry, std::max(precision.texCoordBits, 1u)),
                               namedBounds(geometry)};
  const ElementDifference difference = compare(input, site, bounds);
  count(difference, input, site, topology, report);
  const char* elements = nameOf(topology);
  if (difference.missing > 0)
    findings.add("{} {} of the input are missing from the site.", difference.missing, elements);
  if (difference.extra > 0)
    findings.add("{} {} of the site are not in the input.", difference.extra, elements);

  // The decoder's single precision adds to a normal's bound what its own rounding may turn it by.
  constexpr double normalTolerance = 2e-5;
  if (!mesh.normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
  report.normalErrorDegrees = std::max(report.normalErrorDegrees, difference.normalDegrees);
  if (difference.normalDegrees > bounds.normalDegrees + normalTolerance)
    findings.add("Normals are off by up to {:.4g} degrees, more than their rounding, {:.4g}.", difference.normalDegrees,
                 bounds.normalDegrees);
  if (difference.texCoord.x > bounds.texCoord.x || difference.texCoord.y > bounds.texCoord.y)
    findings.add("Texture coordinates are off by up to {:.4g} and {:.4g}, more than their rounding, {:.4g} "
                 "and {:.4g}.",
                 difference.texCoord.x, difference.texCoord.y, bounds.texCoord.x, bounds.texCoord.y);
  report.attributeError = std::max(report.attributeError, difference.named);
  if (difference.named > 1)
    findings.add("Further attributes are off by up to {:.4g} times what their rounding allows.", difference.named);
  if (difference.colorsDiffering > 0)
    findings.add("{} {} have other colours.", difference.colorsDiffering, elements);
}

/// Nothing in a site of another program.
std::optional<SiteManifest> manifestOf(const SiteDocument& document) {
  const fs::path file = document.root / manifestName;
  std::error_code none;
  if (!fs::exists(file, none))
    return std::nullopt;
  return readManifest(asText(readFile(file)), file.string());
}

/// The input, with normals computed as they were for our site; for another's only with its own.
Imported prepared(const fs::path& input, const std::optional<SiteManifest>& manifest, bool outside) {
  std::uint64_t bytes = 0;
  ImportOptions options;
  options.outside = outside;
  options.inlineBytes = inlineBytes;
  if (manifest)
    options.attributes.names = {manifest->attributes.begin(), manifest->attributes.end()};
  Imported imported = importInput(input, options, bytes);
  std::vector<bool> hadNormals;
  for (const Mesh& mesh : imported.scene.meshes)
    hadNormals.push_back(!mesh.normals.empty());
  const SiteManifest made = manifest.value_or(SiteManifest{});
  prepareScene(imported.scene, made.dropped, made.normalWeighting, locationOf(input));
  for (std::size_t i = 0; i < hadNormals.size(); ++i)
    if (!manifest && !hadNormals[i])
      imported.scene.meshes[i].normals.clear();
  return imported;
}

/// Shapes are compared where they stand; what they show once for each mesh.
void compareScenes(const SiteDocument& document, const Scene& input, const std::optional<SiteManifest>& manifest,
                   VerifyReport& report, Findings& findings) {
  const SceneGraph& siteGraph = document.scene.graph;
  const std::vector<ShapeInstance> inSite = shapeInstances(siteGraph, (document.root / document.name).string()),
                                   inInput = shapeInstances(input.graph);
  if (inSite.size() != inInput.size())
    return findings.add("The site has {} shapes, the input {}.", inSite.size(), inInput.size());
  const ContainerReader reader(fetchFrom(document));
  std::set<std::pair<std::size_t, std::size_t>> compared;
  std::size_t misplaced = 0, otherwise = 0;
  for (std::size_t i = 0; i < inSite.size(); ++i) {
    const Shape &siteShape = shapeOf(siteGraph, inSite[i].node), &inputShape = shapeOf(input.graph, inInput[i].node);
    const std::size_t geometry = siteShape.mesh, mesh = inputShape.mesh;
    if (manifest && inputShape.appearance) {
      ++report.comparedMaterials;
      otherwise += !haveEqualAppearances(siteGraph, siteShape, input.graph, inputShape);
    }
    misplaced += !agree(inSite[i].worldFromShape, inInput[i].worldFromShape, boxOf(input.meshes[mesh]));
    if (compared.emplace(geometry, mesh).second)
      compareMesh(reader, document.scene.geometries.at(geometry), input.meshes[mesh], manifest, report, findings);
  }
  if (misplaced > 0)
    findings.add("{} of {} shapes stand elsewhere than in the input.", misplaced, inSite.size());
  if (otherwise > 0)
    findings.add("{} of {} shapes have other materials than in the input, or other places of textures.", otherwise,
                 report.comparedMaterials);
}

} // namespace

VerifyReport verify(const fs::path& site, const fs::path& input, bool outside) {
  VerifyReport report;
  Findings findings(report);
  const SiteDocument document = openDocument(site);
  const std::optional<SiteManifest> manifest = manifestOf(document);
  report.isForeign = !manifest;
  const Imported imported = prepared(input, manifest, outside);

  // An Error of a reader is a difference between site and input here, not the end of the program.
  try {
    if (manifest)
      checkDocuments(document, findings);
    if (!imported.scene.graph.isComplete) // otherwise the input itself may hold what is wrong
      for (const std::string& warning : document.scene.warnings)
        findings.add("{}", warning);
    if (checkFiles(document, report.isForeign, imported.scene.graph, findings))
      compareScenes(document, imported.scene, manifest, report, findings);
  } catch (const Error& error) {
    findings.add("{}.", error.what());
  }
  report.equal = report.findings.empty();
  return report;
}

} // namespace imgeo
