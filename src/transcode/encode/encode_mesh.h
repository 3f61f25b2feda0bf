#pragma once
// A prepared mesh -> the geometry files of a site.

#include "containers/compact/compact_patch.h"
#include "containers/container.h"
#include "imgeo/convert.h"
#include "transcode/site/content_files.h"

#include <functional>
#include <optional>

namespace imgeo {

/// What became of a mesh, counted as it is drawn.
struct EncodedMesh {
  GeometryDescription geometry;
  std::optional<compact::CompactPatch> base;  ///< the geometry's, which has no file yet
  std::optional<compact::CompactPatch> small; ///< its only patch, which has none either: many share one
  ElementCounts elements;
  std::size_t vertices = 0;
  ElementCounts collapsed;       ///< those that lost their area or length on the lattice
  double positionError = 0;      ///< by which its vertices may be off, along an axis
  double normalErrorDegrees = 0; ///< by which its stored normals may be off
  bool hasNormals = false, hasColors = false;
  std::optional<double> texCoordError; ///< by which its texture coordinates may be off, where it has any
};

/// Called with how many more elements have been written.
using ElementsDone = std::function<void(std::size_t count)>;

/// Vertices (wedges) of a patch of compact that shares its file with others, at most; and
/// of all patches of such a file: docs/decisions/compact.md has the measurement.
inline constexpr std::size_t sharedFileVertices = 16384;

/// Cuts a mesh into patches and writes them, but for what is to share a file, several at a time; a patch's
/// memory is given back when its files are written, so that the peak is the patches and not their encodings.
/// `mesh` is used up. Deterministic.
EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done);

} // namespace imgeo
