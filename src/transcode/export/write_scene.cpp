#include "transcode/export/write_scene.h"

#include "base/file.h"
#include "scene/shape_instances.h"

namespace imgeo {

ExportReport writeScene(const Scene& scene, MeshFormat format, const std::filesystem::path& output) {
  ExportReport report;
  report.format = nameOf(format);
  for (const ShapeInstance& instance : shapeInstances(scene.graph)) {
    const Mesh& mesh = scene.meshes[shapeOf(scene.graph, instance.node).mesh];
    ++report.shapes;
    report.vertices += mesh.wedgeCount();
    report.elements.of(mesh.topology) += mesh.elementCount();
  }
  const Bytes bytes = exportScene(scene, format);
  report.bytes = bytes.size();
  writeFile(output, bytes);
  return report;
}

} // namespace imgeo
