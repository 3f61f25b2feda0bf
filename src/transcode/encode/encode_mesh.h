#pragma once
// Encodes a prepared mesh into the geometry files of a site.

#include "containers/shared_file.h"
#include "imgeo/convert.h"
#include "transcode/encode/atlas.h"
#include "transcode/site/content_files.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// An encoded mesh: its description, patches that are not written yet, and measurements.
struct EncodedMesh {
  GeometryDescription geometry;
  std::unique_ptr<PreparedPatch> base;  ///< base mesh, to be written by BaseFiles; nullptr: none
  std::unique_ptr<PreparedPatch> small; ///< the only patch, to be written by PatchFiles; nullptr: patches are written
  ElementCounts elements;               ///< as drawn
  std::size_t vertices = 0;
  ElementCounts collapsed;       ///< elements that lost their area or length on the lattice
  double positionError = 0;      ///< maximum error of a vertex along an axis
  double normalErrorDegrees = 0; ///< maximum error of stored normals
  bool hasNormals = false, hasColors = false;
  double colorError = 0;                  ///< maximum error of a colour's channel, 0 .. 1
  std::optional<double> texCoordError;    ///< maximum error of texture coordinates, if there are any
  std::optional<ResampledMesh> resampled; ///< if it became geometry images
  bool hasResampledImages = false;        ///< images of groups, of new charts of its texture
  std::vector<std::string> warnings{};    ///< one sentence each
};

/// The options of convert that encoding needs. All defaults are filled in.
EncodeOptions encodeOptionsFrom(const ConvertOptions& options);

/// Sets which attributes a mesh has and the errors of its texture coordinates and colours, by some of the vertices that
/// it stores.
void noteAttributes(EncodedMesh& mesh, const VertexAttributes& vertices, const ConvertOptions& options);

/// Writes the files of a patch and returns its description with their names.
PatchDescription writePatch(const EncodedPatch& patch, ContentFiles& files);

/// Called with the number of elements that have been written since the last call. May be called from any thread.
using ElementsDone = std::function<void(std::size_t count)>;

/// Cuts a mesh into patches, encodes them in parallel and writes them, except a single small patch, which will share a
/// file. The memory of a patch is freed as soon as its files are written. Deterministic.
/// `atlas`: the texture of the mesh, which may become images of groups of levels of detail.
EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done,
                       const Atlas& atlas = {});

/// The same on a given lattice, which contains the mesh, and without a base mesh.
EncodedMesh encodeMesh(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                       const ElementsDone& done);

} // namespace imgeo
