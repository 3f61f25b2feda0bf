// A generated scene -> a mesh file.

#include "transcode/sample/sample_file.h"
#include "base/error.h"
#include "base/file.h"
#include "export/export.h"
#include "scene/shape_instances.h"
#include "transcode/sample/sample_hall.h"

namespace imgeo {

ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output) {
  if (meshFormatOf(output) != MeshFormat::glb)
    throw Error(ErrorKind::usage, output.string(), "does not end in .glb, the format that keeps a hall's structure");
  const Scene scene = hallScene(seats);
  ExportReport report;
  report.format = nameOf(MeshFormat::glb);
  for (const ShapeInstance& placed : shapeInstances(scene.graph)) {
    const Mesh& mesh = scene.meshes[shapeOf(scene.graph, placed.node).mesh];
    ++report.shapes;
    report.vertices += mesh.wedgeCount();
    report.elements.of(mesh.topology) += mesh.elementCount();
  }
  const Bytes bytes = exportScene(scene, MeshFormat::glb);
  report.bytes = bytes.size();
  writeFile(output, bytes);
  return report;
}

} // namespace imgeo
