#pragma once
// The triangles of a region of a level, as they were scattered, and their normals.

#include "transcode/out_of_core/level_regions.h"

#include <array>
#include <span>
#include <tuple>
#include <vector>

namespace imgeo {

/// The triangles of a region and those that touch it, in the order of the source.
class RegionTriangles {
public:
  /// Reads them. `level` must outlive the object.
  RegionTriangles(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region);

  std::size_t count() const { return records_.size() / level_.layout.recordFloats(); }
  const float* record(std::size_t triangle) const { return records_.data() + triangle * level_.layout.recordFloats(); }
  bool isGhost(std::size_t triangle) const { return isGhostTag(tagOf(record(triangle))); }

  /// The region of a corner's point.
  std::uint32_t homeOf(const Vec3f& point) const { return level_.tree.regionOf(keyOfPoint(axes_, point)); }

  /// By corner of all triangles: the lattice point.
  std::vector<Vec3f> points() const;
  /// By corner of all triangles: the position in the record.
  std::vector<Vec3f> positions() const;
  /// By corner: the normal that computeNormals() gives it, of the triangles around its position that are here.
  std::vector<Vec3f> computedNormals() const;
  /// By corner of the region's own triangles: the normals, of which neighbours have computed some (borderNormalsOf).
  std::vector<Vec3f> ownNormals(const std::vector<Vec3f>& points, const WorkFolder& work, std::uint32_t region) const;

  /// The records without ghosts. The object has none afterwards.
  std::vector<float> takeOwnRecords();

private:
  void addToLabels(std::size_t firstFloat, std::uint32_t firstLabel);

  const RegionedLevel& level_;
  std::array<FrameKey, 3> axes_;
  std::vector<float> records_;
};

/// Orders positions by x, then y, then z.
inline auto orderOf(const Vec3f& position) {
  return std::tuple(position.x, position.y, position.z);
}

/// Lattice points of positions in records; without a lattice they are lattice points already.
std::vector<Vec3f> latticePoints(std::span<const Vec3f> positions, const Lattice* lattice);

} // namespace imgeo
