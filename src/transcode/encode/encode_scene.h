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

/// A prepared scene, which has at least one shape or is complete (an X3D source), and what of it is elsewhere.
struct SceneSource {
  Scene scene;
  std::span<const Recording> recordings;      ///< their meshes become sequences
  std::map<std::size_t, WrittenMesh> written; ///< by number of the mesh
  const StoredMeshes* stored = nullptr;       ///< meshes that are on the disk, of which one is in memory at a time
};

/// Options and outputs of encodeScene; all outlive it.
struct SceneEncoding {
  const ConvertOptions& options;
  const ConvertOptions& ofSequences; ///< of SIG classic
  ContentFiles& files;
  ConvertReport& report;    ///< gets counts and errors
  const ElementsDone& done; ///< gets the frames of sequences, too
};

struct EncodedScene {
  SceneDocument document;
  std::vector<bool> hasNormals; ///< by geometry: whether it is known to have normals
};

/// Encodes every mesh once, however many shapes use it, in the spatial order of the shapes, and writes its files.
EncodedScene encodeScene(SceneSource&& source, const SceneEncoding& encoding);

} // namespace imgeo
