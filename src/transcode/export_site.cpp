// A site -> a mesh file: read back, welded, written.

#include "base/error.h"
#include "base/file.h"
#include "export/export.h"
#include "transcode/read_meshes.h"
#include "transcode/site_reader.h"
#include "transcode/transcode.h"

namespace imgeo {

namespace fs = std::filesystem;

ExportReport exportSite(const fs::path& site, const fs::path& output) {
  const std::optional<MeshFormat> format = meshFormatOf(output);
  if (!format)
    throw Error(ErrorKind::usage, output.string(),
                "ends in none of .ply, .obj and .glb, which say what to write");
  const Scene scene = readMeshes(openDocument(site));

  ExportReport report;
  report.format = nameOf(*format);
  report.shapes = scene.shapes.size();
  for (const Shape& shape : scene.shapes) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    report.vertices += mesh.wedgeCount();
    report.elements.of(mesh.topology) += mesh.elementCount();
  }
  const Bytes bytes = exportScene(scene, *format);
  report.bytes = bytes.size();
  writeFile(output, bytes);
  return report;
}

} // namespace imgeo
