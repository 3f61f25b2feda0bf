// Exports a site to a mesh file: reads the geometry, welds it and writes it.

#include "transcode/export/export_site.h"

#include "base/error.h"
#include "base/file.h"
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

} // namespace

ExportReport exportSite(const fs::path& site, const fs::path& output) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(), "ends in none of .ply, .obj and .glb, which say what to write");
  const SiteDocument document = openDocument(site);
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
