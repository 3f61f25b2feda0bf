#pragma once
/// @file
/// Comparison of a site with the file that it was made from.

#include "imgeo/elements.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

/// Result of a comparison.
struct VerifyReport {
  bool equal = false;                ///< there are no findings
  bool isForeign = false;            ///< there is no imgeo.json: another program wrote the site
  ElementCounts input;               ///< elements of the input
  ElementCounts site;                ///< elements of the site
  ElementCounts missing;             ///< elements of the input that the site lacks
  ElementCounts extra;               ///< elements of the site that the input lacks
  double positionError = 0;          ///< maximum of a vertex's error along an axis, in the mesh's units
  double positionBound = 0;          ///< allowed error: half a lattice step
  double normalErrorDegrees = 0;     ///< maximum of a normal's error
  double normalBoundDegrees = 0;     ///< allowed error of normals
  std::size_t resampledMeshes = 0;   ///< meshes that the site has as geometry images
  double surfaceDistance = 0;        ///< the largest distance between their surfaces, as ResampledMesh has it
  double surfaceDistanceBound = 0;   ///< what the site states of it, for the mesh that comes closest to it
  std::size_t instances = 0;         ///< shapes that the site shows as others, moved and turned, and that equal these
  double instanceDistance = 0;       ///< the largest distance of their vertices from those of the input
  double instanceDistanceBound = 0;  ///< what the site states of it
  std::size_t frames = 0;            ///< frames of a sequence that were compared
  std::size_t comparedMaterials = 0; ///< shapes whose materials were compared
  /// Maximum error of texture coordinates, colours and further attributes, as a fraction of the allowed error.
  double attributeError = 0;
  std::vector<std::string> findings; ///< one sentence for each difference
  /// One sentence for what the site has and the input's format cannot express, so that it is not compared.
  std::vector<std::string> notCompared;
};

/// How a site is compared with its input.
struct VerifyOptions {
  bool outside = false;               ///< the input may refer to files outside of its folder
  std::uint64_t memoryBytes = 0;      ///< at least 2^28: where comparing a mesh with levels of detail would take more
                                      ///< memory, it is done out of core; 0: three quarters of the machine's
  std::filesystem::path workFolder{}; ///< compare out of core, with intermediate files here; empty: a folder beside
                                      ///< the site, where it has to be
};

/// Reads the site back and compares it with the input, prepared as `convert` does it (welded, unreferenced positions
/// dropped, normals computed). Compares elements, vertex attributes and transforms of shapes and, unless the input is
/// X3D, whose appearances are copied, their materials: that of an exported GLB may be what glTF has instead of an X3D
/// Material. Does not compare lights, viewpoints and the pixels of textures.
///
/// It compares the surfaces of geometry images, whose distance must be within what the site states, and the vertices:
/// each is on the input's surface, and has the attributes that the surface has there, within their rounding. Geometry
/// with operators must draw what the input has: vertices and centres of elements, not their normals, are compared.
///
/// Geometry nodes of the site's documents (Box, small IndexedFaceSets) are compared with those of an X3D input field by
/// field, and with the meshes of any other input as meshes. A Text, which has no mesh, is a finding then.
///
/// Animations are compared node by node. With a glTF file, such as an export, those of an X3D source are compared as
/// glTF has them: the values over time of transforms and of weights of morph targets. What glTF cannot express (other
/// routes, interpolators and sensors, when a TimeSensor plays) is in VerifyReport::notCompared.
///
/// For a site of another program, file names and computed normals are not checked, and vertices may be off by a
/// twentieth of a lattice step more.
///
/// Meshes and clouds with levels of detail that were made of files which convert() reads in pieces are compared out of
/// core, one after the other and region by region, where memory does not hold them: with the same result.
///
/// An Error that reading the site causes is a finding. Of several meshes, findings begin with the shape of the mesh
/// that they are about. Throws Error if the document or imgeo.json cannot be read, and for the input; Error{usage,
/// unsupported} where the options ask for a comparison out of core that is not possible.
VerifyReport verify(const std::filesystem::path& site, const std::filesystem::path& input,
                    const VerifyOptions& options = {});

/// Compares a site that plays a sequence with the files of its frames, in their order: the same elements in each frame,
/// their positions, and the normals and colours that frames have of the source, within the rounding of their bits. One
/// file is compared by verify().
VerifyReport verifySequence(const std::filesystem::path& site, const std::vector<std::filesystem::path>& frames,
                            const VerifyOptions& options = {});

} // namespace imgeo
