#include "transcode/source/inspect_source.h"

#include "scene/shape_instances.h"
#include "transcode/source/preparation.h"

namespace imgeo {

SourceInfo inspectSource(const std::filesystem::path& file, bool outside) {
  SourceInfo info;
  ImportOptions options;
  options.outside = outside;
  const Imported imported = importInput(file, options, info.bytes);
  info.format = imported.format;
  info.warnings = imported.warnings;
  info.attributes = imported.attributes;
  info.timeSensors = countNodes<TimeSensor>(imported.scene.graph);
  info.interpolators = countNodes<Interpolator>(imported.scene.graph);
  info.routes = imported.scene.graph.routes.size();
  info.skins = countNodes<Humanoid>(imported.scene.graph);
  info.displacers = countNodes<Displacer>(imported.scene.graph);
  const std::vector<ShapeInstance> instances = shapeInstances(imported.scene.graph);
  info.shapes = instances.size();
  for (const ShapeInstance& instance : instances)
    for (const Vec3f& position : imported.scene.meshes[shapeOf(imported.scene.graph, instance.node).mesh].positions)
      info.box.add(instance.worldFromShape.point(Vec3d(position)));
  for (const Mesh& mesh : imported.scene.meshes) {
    info.elements.of(mesh.topology) += mesh.elementCount();
    info.vertices += mesh.wedgeCount();
    info.normals |= !mesh.normals.empty();
    info.texCoords |= !mesh.texCoords.empty();
    info.texCoordSets = std::max(info.texCoordSets, static_cast<std::uint32_t>(texCoordSetCount(mesh)));
    info.colors |= !mesh.colors.empty();
  }
  return info;
}

} // namespace imgeo
