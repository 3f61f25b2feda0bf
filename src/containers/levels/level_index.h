#pragma once
// The index of the levels of detail of a mesh or a point cloud: the groups of all levels with their bounds, errors,
// sizes and children.
// Specification: docs/formats/levels.md.

#include "base/bytes.h"
#include "base/vec.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

inline constexpr std::uint32_t maxLevelGroups = 1u << 22;     ///< of all levels
inline constexpr std::uint32_t maxLevelPageGroups = 1u << 16; ///< of a page
inline constexpr std::uint32_t maxLevelCount = 32;
inline constexpr std::uint32_t minLevelPositionBits = 1, maxLevelPositionBits = 24;
inline constexpr std::uint32_t maxGroupCount = 1u << 20; ///< vertices, and triangles, of a group: those of a file
inline constexpr std::uint32_t maxGroupBytes = (1u << 28) - 1;
inline constexpr std::uint32_t maxChipImageEdge = 16384; ///< of a group's image

/// The bit of the features of an index whose groups hold points.
inline constexpr std::uint8_t pointsFeature = 1;

/// The error code of roots, which are always open.
inline constexpr std::uint8_t rootErrorCode = 255;
/// A feature of the index: each group has an image.
inline constexpr std::uint8_t chipFeature = 4;
/// The radius code of a sphere that contains every other.
inline constexpr std::uint16_t unboundedRadiusCode = 65535;

/// A sphere around a group and its coarse form, in codes; with nested spheres also around those of its children.
struct LevelSphere {
  Vec3<std::uint16_t> center; ///< in units of levelUnit() lattice steps
  std::uint16_t radius = 0;   ///< in fourfold units; unboundedRadiusCode: contains every sphere
  friend bool operator==(const LevelSphere&, const LevelSphere&) = default;
};

struct LevelGroup {
  std::uint8_t level = 0; ///< 0: the quantised mesh
  LevelSphere sphere;
  /// How far the surface, or a point, of the group is at most from its coarse form: statedError() lattice steps.
  std::uint8_t errorCode = rootErrorCode;
  /// Counts of the group's file; vertices are wedges, or the points, of which there are no triangles.
  std::uint32_t vertices = 0, triangles = 0;
  std::uint32_t bytes = 0; ///< of the group's file
  /// Columns, rows and bytes of the group's image; 0 where the index has none.
  std::uint32_t chipColumns = 0, chipRows = 0, chipBytes = 0;
  /// The groups of the level below whose coarse forms this group has, ascending: child i is segment i of its file.
  std::vector<std::uint32_t> children{};
  friend bool operator==(const LevelGroup&, const LevelGroup&) = default;
};

/// Groups are numbered from the highest level down, so that a group's parents have lower numbers.
struct LevelIndex {
  std::uint32_t positionBits = 16;
  std::uint32_t pageGroups = 1024; ///< groups of each page but the last
  std::uint32_t rootCount = 1;     ///< groups of the highest level
  bool hasPoints = false;          ///< whether groups hold points in place of triangles
  bool hasChips = false;           ///< whether each group, of triangles, has an image
  bool hasNestedSpheres = false;   ///< version 1: spheres contain those of children, and so are several times as large
  std::vector<LevelGroup> groups;

  std::uint32_t levelCount() const { return groups.empty() ? 0 : groups.front().level + 1u; }
  std::size_t pageCount() const { return (groups.size() + pageGroups - 1) / pageGroups; }
  friend bool operator==(const LevelIndex&, const LevelIndex&) = default;
};

/// The unit of the centres of spheres in lattice steps: 2^(positionBits - 16), and 1 for fewer bits.
std::uint32_t levelUnit(std::uint32_t positionBits);

/// 2^(code / 8) lattice steps.
double statedError(std::uint8_t errorCode);

/// The smallest code below rootErrorCode whose stated error is at least `steps`; rootErrorCode - 1 for larger ones.
std::uint8_t errorCodeFor(double steps);

/// Whether `outer` contains `inner`, in integers.
bool contains(const LevelSphere& outer, const LevelSphere& inner);

/// The bounds of a group in lattice steps, without those of the groups that refine it.
struct GroupBounds {
  Vec3d center;
  double radius = 0; ///< of a sphere around its vertices and those of its coarse form
  double error = 0;  ///< distance of its surface from its coarse form, with the errors of its children; roots: not used
};

/// Sets the spheres and error codes of all groups: errors, and nested spheres, of each group larger than those of its
/// children. `bounds` has an element for each group.
void setBounds(LevelIndex& index, std::span<const GroupBounds> bounds);

/// "0/7.png": the file of a group relative to the index.
std::string groupFileName(std::uint32_t group);

/// The url of a group's file, of an index or of a document that names the index.
std::string groupUrl(const std::string& indexUrl, std::uint32_t group);

/// The same for the group's image: "0/7.webp".
std::string chipFileName(std::uint32_t group);
std::string chipUrl(const std::string& indexUrl, std::uint32_t group);

/// The url of a page: "levels.png" for the index "levels.png" and page 0, "levels-2.png" for page 2.
std::string levelPageUrl(const std::string& indexUrl, std::size_t page);

/// The files of all pages. `index` is one that readers accept. Deterministic.
std::vector<Bytes> writeLevelIndex(const LevelIndex& index);

/// The payloads of the pages, whose files have the given sizes; those of the first page are not used.
Bytes levelPagePayload(const LevelIndex& index, std::size_t page, std::span<const std::uint32_t> pageBytes);

/// Gives the bytes of a url.
using FetchLevelFile = std::function<Bytes(const std::string& url)>;

/// Reads all pages of an index. Safe for untrusted bytes: time and memory are proportional to the bytes. Throws
/// Error{truncated, malformed, unsupported, limit} naming the url of a page.
LevelIndex readLevelIndex(const std::string& url, const FetchLevelFile& fetch);

/// The same for the payloads of pages, for tests and fuzzing; without the sizes of files.
LevelIndex readLevelPayloads(std::span<const Bytes> payloads, const std::string& url);

} // namespace imgeo
