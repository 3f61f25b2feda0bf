// Exports a site to a mesh file: reads the geometry, welds it and writes it.

#include "transcode/export/export_site.h"

#include "base/error.h"
#include "base/file.h"
#include "containers/encodings.h"
#include "export/export.h"
#include "scene/source_axes.h"
#include "transcode/export/write_scene.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/sequences.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"

#include <algorithm>
#include <fmt/format.h>

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

/// Adds operators to those of every geometry.
void addOperators(SceneDocument& document, std::span<const Operator> operators, const std::string& location) {
  for (GeometryDescription& geometry : document.geometries) {
    const bool hasImages = rowOf(geometry).storage == PatchStorage::bytePlanes;
    if (blurRadiusOf(operators) > 0 && !(hasImages && geometry.operators.empty()))
      throw Error(ErrorKind::unsupported, location,
                  hasImages ? "has operators, after which an image cannot be blurred"
                            : "has geometry without images of coordinates, which blur filters");
    geometry.operators.insert(geometry.operators.end(), operators.begin(), operators.end());
  }
  if (orientationOf(operators) == Orientation::folded)
    for (const std::size_t node : shapeNodes(document.graph))
      std::get<Shape>(document.graph.nodes[node].content).solid = false;
}

} // namespace

namespace {

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
  return report;
}

SiteSequence onlySequence(const SiteDocument& document, const fs::path& site) {
  std::vector<SiteSequence> sequences = sequencesOf(document);
  if (sequences.size() != 1)
    throw Error(ErrorKind::usage, site.string(),
                fmt::format("plays {} sequences; frames are exported of one", sequences.size()));
  return std::move(sequences.front());
}

} // namespace

ExportReport exportSite(const fs::path& site, const fs::path& output, std::span<const Operator> operators) {
  formatFor(output);
  SiteDocument document = openDocument(site);
  addOperators(document.scene, operators, site.string());
  return write(document, readMeshes(document), output);
}

ExportReport exportFrame(const fs::path& site, std::uint32_t frame, const fs::path& output) {
  formatFor(output);
  const SiteDocument document = openDocument(site);
  const SiteSequence sequence = onlySequence(document, site);
  if (frame >= sequence.index.frameCount())
    throw Error(ErrorKind::usage, "--frame",
                fmt::format("{} is not below {}, the number of frames", frame, sequence.index.frameCount()));
  Scene scene = readMeshes(document);
  const std::size_t mesh = shapeOf(document.scene.graph, sequence.shape).mesh;
  const GeometryDescription& geometry = document.scene.geometries.at(mesh);
  const IndexedPatch still = ContainerReader(fetchFrom(document)).decode(geometry.patches.at(0), geometry);
  readFrames(document, sequence, frame, frame + 1, [&](const live::Frame& read) {
    std::string name = std::move(scene.meshes.at(mesh).name);
    scene.meshes.at(mesh) = meshOfFrame(still, read, sequence.index.description);
    scene.meshes.at(mesh).name = std::move(name);
  });
  return write(document, std::move(scene), output);
}

std::uint32_t frameCountOf(const fs::path& site) {
  return onlySequence(openDocument(site), site).index.frameCount();
}

} // namespace imgeo
