#pragma once
// A prepared mesh -> the geometry files of a site.

#include "containers/compact/compact_patch.h"
#include "containers/container.h"
#include "imgeo/convert.h"
#include "transcode/site/content_files.h"

#include <functional>
#include <optional>

namespace imgeo {

/// An encoded mesh: its description, patches that are not written yet, and measurements.
struct EncodedMesh {
  GeometryDescription geometry;
  std::optional<compact::CompactPatch> base;  ///< base mesh, to be written by BaseFiles
  std::optional<compact::CompactPatch> small; ///< the only patch, to be written by PatchFiles
  ElementCounts elements;                     ///< as drawn
  std::size_t vertices = 0;
  ElementCounts collapsed;       ///< elements that lost their area or length on the lattice
  double positionError = 0;      ///< maximum error of a vertex along an axis
  double normalErrorDegrees = 0; ///< maximum error of stored normals
  bool hasNormals = false, hasColors = false;
  std::optional<double> texCoordError; ///< maximum error of texture coordinates, if there are any
};

/// Called with the number of elements that have been written since the last call. May be called from any thread.
using ElementsDone = std::function<void(std::size_t count)>;

/// Maximum number of wedges of a file of compact that several patches share: docs/decisions/compact.md has the
/// measurement. Larger patches have a file of their own.
inline constexpr std::size_t maxSharedFileWedges = 16384;

/// Cuts a mesh into patches, encodes them in parallel and writes them, except a single small patch, which will share a
/// file. The memory of a patch is freed as soon as its files are written. Deterministic.
EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done);

} // namespace imgeo
