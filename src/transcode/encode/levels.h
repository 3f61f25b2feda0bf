#pragma once
// Encodes a large mesh as levels of detail.

#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// Whether a mesh gets levels: as the options say, if the encoding has them, the mesh has more triangles than a group,
/// they do not move, and its lattice has at most maxLevelBits.
bool getsLevels(const Mesh& mesh, const Lattice& lattice, const ConvertOptions& options);

/// Builds and writes the levels of a mesh on a lattice that contains it: the files of all groups, and the index.
/// Deterministic.
EncodedMesh encodeLevels(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                         const ElementsDone& done);

} // namespace imgeo
