// Exports a site to a mesh file: reads the geometry, welds it and writes it.

#include "transcode/export/export_site.h"

#include "base/error.h"
#include "base/file.h"
#include "containers/encodings.h"
#include "export/export.h"
#include "scene/source_axes.h"
#include "transcode/export/write_scene.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"

#include <algorithm>

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

ExportReport exportSite(const fs::path& site, const fs::path& output, std::span<const Operator> operators) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(), "ends in none of .ply, .obj and .glb, which say what to write");
  SiteDocument document = openDocument(site);
  addOperators(document.scene, operators, site.string());
  Scene scene = readMeshes(document);
  if (*format == MeshFormat::glb) // PLY and OBJ do not contain images
    readImages(document, scene.graph);

  // PLY and OBJ have no convention for axes and unit: they get the source's. glTF is y up, in metres.
  if (*format != MeshFormat::glb)
    if (const std::optional<SiteManifest> manifest = manifestOf(document))
      undoSourceAxes(scene.graph, manifest->axes);

  ExportReport report = writeScene(scene, *format, output);
  if (*format == MeshFormat::glb)
    report.lightsLeftOut = lightsLeftOut(scene.graph);
  return report;
}

} // namespace imgeo
