// A site -> a mesh file: read back, welded, written.

#include "transcode/export/export_site.h"
#include "base/error.h"
#include "base/file.h"
#include "export/export.h"
#include "scene/shape_instances.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/site_document.h"

#include <algorithm>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// The images that are in the site; those of other hosts stay away.
void readImages(const SiteDocument& document, SceneGraph& graph) {
  const std::vector<std::string> urls = textureFilesOf(document.scene);
  for (ImageFile& image : graph.images)
    if (std::ranges::find(urls, image.url) != urls.end())
      image.bytes = readFile(fileOf(document, image.url));
}

} // namespace

ExportReport exportSite(const fs::path& site, const fs::path& output) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(), "ends in none of .ply, .obj and .glb, which say what to write");
  const SiteDocument document = openDocument(site);
  Scene scene = readMeshes(document);
  if (*format == MeshFormat::glb) // the others have no place for images
    readImages(document, scene.graph);

  ExportReport report;
  if (*format == MeshFormat::glb)
    report.lightsLeftOut = lightsLeftOut(scene.graph);
  report.format = nameOf(*format);
  for (const ShapeInstance& placed : shapeInstances(scene.graph)) {
    const Mesh& mesh = scene.meshes[shapeOf(scene.graph, placed.node).mesh];
    ++report.shapes;
    report.vertices += mesh.wedgeCount();
    report.elements.of(mesh.topology) += mesh.elementCount();
  }
  const Bytes bytes = exportScene(scene, *format);
  report.bytes = bytes.size();
  writeFile(output, bytes);
  return report;
}

} // namespace imgeo
