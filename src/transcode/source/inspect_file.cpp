// What single files hold: a mesh to convert, a geometry file of a site.

#include "base/file.h"
#include "containers/png/png.h"
#include "scene/shape_instances.h"
#include "transcode/source/preparation.h"
#include "transcode/transcode.h"

namespace imgeo {

SourceInfo inspectSource(const std::filesystem::path& file, bool outside) {
  SourceInfo info;
  ImportOptions options;
  options.outside = outside;
  const Imported imported = importInput(file, options, info.bytes);
  info.format = imported.format;
  info.warnings = imported.warnings;
  info.attributes = imported.attributes;
  const std::vector<ShapeInstance> placed = shapeInstances(imported.scene.graph);
  info.shapes = placed.size();
  for (const ShapeInstance& shape : placed)
    for (const Vec3f& position : imported.scene.meshes[shapeOf(imported.scene.graph, shape.node).mesh].positions)
      info.box.add(shape.worldFromShape.point(Vec3d(position)));
  for (const Mesh& mesh : imported.scene.meshes) {
    info.elements.of(mesh.topology) += mesh.elementCount();
    info.vertices += mesh.wedgeCount();
    info.normals |= !mesh.normals.empty();
    info.texCoords |= !mesh.texCoords.empty();
    info.colors |= !mesh.colors.empty();
  }
  return info;
}

GeometryFileInfo inspectGeometryFile(const std::filesystem::path& file) {
  GeometryFileInfo info;
  const Bytes bytes = readFile(file);
  info.bytes = bytes.size();
  info.namedByContent = file.stem() == contentName(bytes);
  info.kind = "typed array";
  if (file.extension() == ".png") {
    const Image image = decodePng(bytes, file.string());
    info.kind = "PNG image";
    info.width = image.width;
    info.height = image.height;
    info.channels = image.channels;
  }
  return info;
}

} // namespace imgeo
