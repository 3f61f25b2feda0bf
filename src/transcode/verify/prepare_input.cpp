#include "transcode/verify/prepare_input.h"

#include "transcode/node_geometry/prepare_as.h"
#include "transcode/source/preparation.h"

namespace imgeo {

Imported preparedInput(const std::filesystem::path& input, const std::optional<SiteManifest>& manifest, bool outside,
                       std::vector<Recording>& recordings) {
  std::uint64_t bytes = 0;
  const ImportOptions options = importOptionsFor(manifest, outside);
  Imported imported = importInput(input, options, bytes);
  if (manifest) {
    recordings = recordScene(imported.scene, options.recordings.rate, options.recordings.all, locationOf(input),
                             imported.warnings);
    prepareAs(*manifest, imported.scene, locationOf(input));
    return imported;
  }
  std::vector<bool> hadNormals;
  for (const Mesh& mesh : imported.scene.meshes)
    hadNormals.push_back(!mesh.normals.empty());
  prepareScene(imported.scene, {.byteColors = false}, locationOf(input));
  for (std::size_t i = 0; i < hadNormals.size(); ++i)
    if (!hadNormals[i])
      imported.scene.meshes[i].normals.clear();
  return imported;
}

} // namespace imgeo
