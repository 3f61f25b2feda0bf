#pragma once
// Encodes a large mesh, or a point cloud, as levels of detail.

#include "containers/levels/group_file.h"
#include "containers/levels/level_index.h"
#include "prepare/levels/levels.h"
#include "scene/appearance.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/encode/level_images.h"

#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// Meshes of more triangles, and clouds of more points, get levels where convert chooses: more than one view needs, and
/// than sixteen patches hold.
inline constexpr std::size_t maxElementsWithoutLevels = 2'000'000;

/// Whether a mesh gets levels: as the options say, if the encoding has them, the mesh has more triangles or points than
/// a group, they do not move, and its lattice has at most maxLevelBits.
bool getsLevels(const Mesh& mesh, const Lattice& lattice, const ConvertOptions& options);

/// Builds and writes the levels of a mesh on a lattice that contains it: the files of all groups, and the index. With
/// the image of an atlas groups have images of their own, unless texture coordinates are outside of 0 .. 1 or the
/// images would have more than maxChipShare times its texels; then all levels draw the whole image, and a warning says
/// so. Deterministic.
EncodedMesh encodeLevels(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                         const ElementsDone& done, const Atlas& atlas = {});

/// The fields of the node of a mesh with levels, from all its attributes, which it leaves as they are.
GeometryDescription describeLeveledMesh(Mesh& mesh, const std::vector<Vec3u>& points, const Lattice& lattice,
                                        const EncodeOptions& options);

/// What is known of the file of a group.
struct GroupFile {
  std::size_t vertices = 0, triangles = 0;
  std::uint32_t bytes = 0;
  double normalError = 0;    ///< in radians
  std::string contentName{}; ///< of its bytes
};

/// What is known of the image of a group.
struct ChipRow {
  RasterSize size; ///< of none: too large
  double texelEdge = 0;
  std::uint32_t bytes = 0;
  std::string contentName{}; ///< of its bytes
};

ChipRow chipRowOf(const ChipFile& image);

/// Enters the images of all groups into an index, in its order.
void addChips(LevelIndex& index, std::span<const ChipRow> chips);

GroupFile groupFileOf(const EncodedGroup& group);

/// The index of levels whose files have been encoded, in the order of their groups.
LevelIndex levelIndexOf(const Levels& levels, std::span<const GroupFile> files, std::uint32_t bits);

/// Adds the groups' names to those of the pages of the index, in the order in which they name the folder.
void addGroupNames(FolderName& name, std::span<const GroupFile> files);

/// Completes an encoded mesh by its levels, whose files have been written with the index at `indexUrl`.
void describeLevels(EncodedMesh& mesh, const std::string& indexUrl, LevelIndex index, std::span<const GroupFile> files);

} // namespace imgeo
