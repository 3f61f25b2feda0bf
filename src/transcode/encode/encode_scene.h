#pragma once
// Turns a prepared scene into its document and writes the geometry files.

#include "documents/documents.h"
#include "scene/stored_meshes.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/source/recordings.h"

#include <map>
#include <span>
#include <vector>

namespace imgeo {

/// A mesh whose files have been written, of which the scene has a coarse form.
struct WrittenMesh {
  EncodedMesh encoded;
  Box3d box; ///< of the mesh
};

struct EncodedScene {
  SceneDocument document;
  std::vector<bool> hasNormals; ///< by geometry: whether it is known to have normals
};

/// Encodes every mesh once, however many shapes use it, in the spatial order of the shapes, and writes its files. Adds
/// counts and errors to `report`. The scene has at least one shape, or is complete (an X3D source). The meshes of
/// recordings become sequences with the options `ofSequences`, of SIG classic; `done` gets their frames. `written`: by
/// number of the mesh. `stored`: meshes that are on the disk, of which one is in memory at a time.
EncodedScene encodeScene(Scene&& scene, const ConvertOptions& options, std::span<const Recording> recordings,
                         const ConvertOptions& ofSequences, std::map<std::size_t, WrittenMesh> written,
                         const StoredMeshes* stored, ContentFiles& files, ConvertReport& report,
                         const ElementsDone& done);

} // namespace imgeo
