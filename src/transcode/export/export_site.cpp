// Exports a site to a mesh file: reads the geometry, welds it and writes it.

#include "transcode/export/export_site.h"

#include "base/data_url.h"
#include "base/error.h"
#include "base/file.h"
#include "containers/encodings.h"
#include "containers/levels/level_patches.h"
#include "export/export.h"
#include "scene/source_axes.h"
#include "transcode/export/write_scene.h"
#include "transcode/node_geometry/open_whole_document.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/sequences.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Reads the texture images of the site, without those of other hosts.
void readImages(const SiteDocument& document, SceneGraph& graph) {
  const std::vector<std::string> urls = textureFilesOf(document.scene);
  for (ImageFile& image : graph.images)
    if (std::ranges::find(urls, image.url) != urls.end())
      image.bytes = readFile(fileOf(document, image.url));
}

/// Whether the numbers of a geometry are in the document: those of a geometry node, or in data: URLs.
bool isInDocument(const GeometryDescription& geometry) {
  return !geometry.patches.empty() && std::ranges::all_of(geometry.patches, [](const PatchDescription& patch) {
    return !patch.coord.empty() && std::ranges::all_of(patch.coord, isDataUrl, &Reference::url);
  });
}

/// By geometry, whether a list that begins with a blur maps it. Of geometry without images, which pages leave as it is,
/// that of the document may stand beside some with images. Throws Error{unsupported} for other geometry.
std::vector<bool> findBlurred(const SceneDocument& document, const std::string& location) {
  std::vector<bool> isBlurred;
  for (const GeometryDescription& geometry : document.geometries) {
    const bool hasImages = rowOf(geometry).storage == PatchStorage::bytePlanes;
    if (hasImages && !geometry.operators.empty())
      throw Error(ErrorKind::unsupported, location, "has operators, after which an image cannot be blurred");
    if (!hasImages && !isInDocument(geometry))
      throw Error(ErrorKind::unsupported, location, "has geometry without images of coordinates, which blur filters");
    isBlurred.push_back(hasImages);
  }
  if (std::ranges::count(isBlurred, true) == 0)
    throw Error(ErrorKind::unsupported, location, "has no images of coordinates, which blur filters");
  return isBlurred;
}

/// Adds operators to those of every geometry, or of those that a blur can filter; warns of the others.
void addOperators(SceneDocument& document, std::span<const Operator> operators, const std::string& location) {
  std::vector<bool> isMapped(document.geometries.size(), true);
  if (blurRadiusOf(operators) > 0)
    isMapped = findBlurred(document, location);
  for (std::size_t i = 0; i < document.geometries.size(); ++i)
    if (isMapped[i])
      document.geometries[i].operators.insert(document.geometries[i].operators.end(), operators.begin(),
                                              operators.end());
  if (const auto count = std::ranges::count(isMapped, false); count > 0)
    document.warnings.push_back(
        fmt::format("{} without operators: blur filters images of coordinates, "
                    "which {} not have.",
                    count == 1 ? "1 geometry is written" : fmt::format("{} geometries are written", count),
                    count == 1 ? "it does" : "they do"));
  if (orientationOf(operators) == Orientation::folded)
    for (const std::size_t node : shapeNodes(document.graph))
      if (Shape& shape = std::get<Shape>(document.graph.nodes[node].content); isMapped[shape.mesh])
        shape.solid = false;
}

} // namespace

namespace {

/// Makes all meshes with levels of detail those of a level, or of their highest.
void chooseLevel(SceneDocument& document, std::uint32_t level, const FetchFile& fetch) {
  std::uint32_t count = 1;
  for (GeometryDescription& geometry : document.geometries)
    if (geometry.levels) {
      const std::uint32_t levels = geometry.levels->index.levelCount();
      count = std::max(count, levels);
      choosePatchesOfLevel(geometry, std::min(level, levels - 1), fetch);
    }
  if (level >= count)
    throw Error(ErrorKind::usage, "--level", fmt::format("{} is not below {}, the number of levels", level, count));
}

MeshFormat formatFor(const fs::path& output) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(), "ends in none of .ply, .obj and .glb, which say what to write");
  return *format;
}

ExportReport write(const SiteDocument& document, Scene scene, const fs::path& output) {
  const MeshFormat format = formatFor(output);
  if (format == MeshFormat::glb) // PLY and OBJ do not contain images
    readImages(document, scene.graph);

  // PLY and OBJ have no convention for axes and unit: they get the source's. glTF is y up, in metres.
  if (format != MeshFormat::glb)
    if (const std::optional<SiteManifest> manifest = manifestOf(document))
      undoSourceAxes(scene.graph, manifest->axes);

  ExportReport report = writeScene(scene, format, output);
  if (format == MeshFormat::glb)
    report.lightsLeftOut = lightsLeftOut(scene.graph);
  report.geometryLeftOut = document.scene.geometryElements;
  report.choicesWritten = document.scene.choiceElements;
  report.warnings = document.scene.warnings;
  return report;
}

/// The sequences of a site, of which there is at least one.
std::vector<SiteSequence> requiredSequences(const SiteDocument& document, const fs::path& site) {
  std::vector<SiteSequence> sequences = sequencesOf(document);
  if (sequences.empty())
    throw Error(ErrorKind::usage, site.string(), "plays no sequence: it has no frames");
  return sequences;
}

std::uint32_t frameCountOf(const std::vector<SiteSequence>& sequences) {
  std::uint32_t count = 0;
  for (const SiteSequence& sequence : sequences)
    count = std::max(count, sequence.index.frameCount());
  return count;
}

/// The mesh of a frame of a sequence, or of its last frame where it is shorter.
Mesh readFrame(const SiteDocument& document, const SiteSequence& sequence, std::uint32_t number) {
  const std::size_t index = shapeOf(document.scene.graph, sequence.shape).mesh;
  const GeometryDescription& geometry = document.scene.geometries.at(index);
  const IndexedPatch still = ContainerReader(fetchFrom(document)).decode(geometry.patches.at(0), geometry);
  const std::uint32_t frame = std::min(number, sequence.index.frameCount() - 1);
  Mesh mesh;
  readFrames(document, sequence, frame, frame + 1,
             [&](const live::Frame& read) { mesh = meshOfFrame(still, read, sequence.index); });
  return mesh;
}

} // namespace

ExportReport exportSite(const fs::path& site, const fs::path& output, std::span<const Operator> operators,
                        std::uint32_t level) {
  formatFor(output);
  SiteDocument document = openWholeDocument(site);
  chooseLevel(document.scene, level, fetchFrom(document));
  addOperators(document.scene, operators, site.string());
  Scene scene = readMeshes(document);
  const std::size_t routesWritten = routesInGltf(scene.graph);
  ExportReport report = write(document, std::move(scene), output);
  if (const auto routes = document.scene.otherElements.find("ROUTE");
      formatFor(output) == MeshFormat::glb && routes != document.scene.otherElements.end())
    report.routesLeftOut = routes->second - std::min(routes->second, routesWritten);
  return report;
}

ExportReport exportFrame(const fs::path& site, std::uint32_t frame, const fs::path& output) {
  formatFor(output);
  const SiteDocument document = openWholeDocument(site);
  const std::vector<SiteSequence> sequences = requiredSequences(document, site);
  if (const std::uint32_t count = frameCountOf(sequences); frame >= count)
    throw Error(ErrorKind::usage, "--frame", fmt::format("{} is not below {}, the number of frames", frame, count));
  Scene scene = readMeshes(document);
  for (const SiteSequence& sequence : sequences) {
    Mesh& mesh = scene.meshes.at(shapeOf(document.scene.graph, sequence.shape).mesh);
    std::string name = std::move(mesh.name);
    mesh = readFrame(document, sequence, frame);
    mesh.name = std::move(name);
  }
  return write(document, std::move(scene), output);
}

std::uint32_t frameCountOf(const fs::path& site) {
  return frameCountOf(requiredSequences(openDocument(site), site));
}

} // namespace imgeo
