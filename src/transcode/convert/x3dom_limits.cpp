#include "transcode/convert/x3dom_limits.h"

#include "import/warnings.h"
#include "scene/deformation.h"
#include "scene/fog_depths.h"
#include "transcode/source/preparation.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

bool leaveOutTexCoords(Scene& scene, std::vector<std::string>& warnings) {
  const auto [meshes, textures] = keepFirstTexCoords(scene);
  if (meshes > 0)
    warnings.push_back(
        fmt::format("X3DOM reads one set of texture coordinates: the others of {} are left out, and with them {}",
                    counted(meshes, "mesh", "meshes"), counted(textures, "texture", "textures")));
  return meshes > 0;
}

void leaveOutFogDepths(Scene& scene, std::vector<std::string>& warnings) {
  std::size_t meshes = 0;
  for (Mesh& mesh : scene.meshes)
    meshes += std::erase_if(mesh.namedAttributes,
                            [](const NamedAttribute& attribute) { return attribute.name == fogDepthName; });
  if (meshes > 0)
    warnings.push_back(
        fmt::format("X3DOM reads no depths in fog: those of {} are left out", counted(meshes, "mesh", "meshes")));
}

void leaveOutDeformations(Scene& scene, std::vector<std::string>& warnings) {
  const std::size_t meshes = removeDeformations(scene);
  if (meshes > 0)
    warnings.push_back(fmt::format("X3DOM reads no joints and displacements of these geometries: {} {} at rest",
                                   counted(meshes, "mesh", "meshes"), meshes == 1 ? "stays" : "stay"));
}

} // namespace

bool leaveOutForX3dom(Scene& scene, std::vector<std::string>& warnings) {
  const bool hasLeftTexCoords = leaveOutTexCoords(scene, warnings);
  leaveOutFogDepths(scene, warnings);
  leaveOutDeformations(scene, warnings);
  return hasLeftTexCoords;
}

} // namespace imgeo
