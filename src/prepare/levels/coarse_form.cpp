#include "prepare/levels/coarse_form.h"

#include "prepare/base_wedges.h"
#include "prepare/incidence.h"
#include "prepare/levels/drop_pieces.h"
#include "prepare/simplify.h"
#include "prepare/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

using Point = Vec3<std::int64_t>;

/// Where more than this share of a group's triangles remain, its pieces have no coarser form, and some are left out.
constexpr double maxSimplifiedShare = 0.5;

/// Pieces of fewer triangles on average are left out whole or kept as they are: a quarter of a box is a sliver.
constexpr double minTrianglesOfPiece = 48;

/// The normal of three lattice points; exact for coordinates of 24 bits.
Point normalOf(const Vec3u& a, const Vec3u& b, const Vec3u& c) {
  return cross(Point(b) - Point(a), Point(c) - Point(a));
}

bool hasEqualCorners(const Patch& patch, std::size_t triangle) {
  const auto at = [&](std::size_t i) -> const Vec3u& {
    return patch.positions[patch.wedgePositions[patch.corners[3 * triangle + i]]];
  };
  return at(0) == at(1) || at(1) == at(2) || at(2) == at(0);
}

/// The triangles without equal corners: their corners as positions, and their indices in the group.
struct ProperTriangles {
  std::vector<std::uint32_t> corners, indices;

  explicit ProperTriangles(const Patch& group) {
    for (std::uint32_t triangle = 0; triangle < group.elementCount(); ++triangle) {
      if (hasEqualCorners(group, triangle))
        continue;
      for (std::size_t i = 0; i < 3; ++i)
        corners.push_back(group.wedgePositions[group.corners[3 * std::size_t{triangle} + i]]);
      indices.push_back(triangle);
    }
  }
};

/// Rounds the positions that are not fixed. A position stays where rounding it would leave a triangle around it without
/// area or turn it over.
void roundPositions(SimplifiedTriangles& simplified, const std::vector<bool>& isFixed, const CoarseOptions& options) {
  const std::uint32_t shift = options.roundingShift;
  if (shift == 0)
    return;
  const std::vector<std::uint32_t>& corners = simplified.corners;
  std::vector<Vec3u>& positions = simplified.positions;
  const Incidence incidence =
      incidenceOf(corners.size(), positions.size(), [&](std::size_t corner) { return corners[corner]; });
  const auto isHarmed = [&](std::uint32_t corner, const Vec3u& rounded) {
    const Vec3u &at = positions[corners[corner]], &b = positions[corners[corner % 3 == 2 ? corner - 2 : corner + 1]],
                &c = positions[corners[corner % 3 == 0 ? corner + 2 : corner - 1]];
    const Vec3d before(normalOf(at, b, c)), after(normalOf(rounded, b, c));
    return !(dot(before, after) > 0);
  };
  for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
    if (isFixed[vertex])
      continue;
    Vec3u rounded;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t nearest = (positions[vertex][axis] + (1u << (shift - 1))) >> shift << shift;
      rounded[axis] = nearest <= options.maximum ? nearest : positions[vertex][axis] >> shift << shift;
    }
    if (std::ranges::none_of(incidence.of(vertex), [&](std::uint32_t corner) { return isHarmed(corner, rounded); }))
      positions[vertex] = rounded;
  }
}

/// By simplified position: whether it is a fixed one of the group.
std::vector<bool> fixedPositions(const SimplifiedTriangles& simplified, const std::vector<bool>& isFixed) {
  std::vector<bool> result(simplified.positions.size());
  for (std::size_t position = 0; position < isFixed.size(); ++position)
    if (isFixed[position] && simplified.vertexOfInput[position] != SimplifiedTriangles::none)
      result[simplified.vertexOfInput[position]] = true;
  return result;
}

/// Sets the normals of wedges at positions that are not fixed to the mean of their triangles', on the side of the
/// normal that they have.
void computeNormals(Patch& patch, const std::vector<bool>& isFixed) {
  if (patch.normals.empty())
    return;
  std::vector<Vec3d> sums(patch.wedgeCount());
  for (std::size_t corner = 0; corner < patch.corners.size(); corner += 3) {
    const auto at = [&](std::size_t i) -> const Vec3u& {
      return patch.positions[patch.wedgePositions[patch.corners[corner + i]]];
    };
    const Vec3d normal(normalOf(at(0), at(1), at(2)));
    for (std::size_t i = 0; i < 3; ++i)
      sums[patch.corners[corner + i]] += normal;
  }
  for (std::size_t wedge = 0; wedge < sums.size(); ++wedge) {
    const double size = length(sums[wedge]);
    if (isFixed[patch.wedgePositions[wedge]] || !(size > 0))
      continue;
    const double side = dot(sums[wedge], Vec3d(patch.normals[wedge])) < 0 ? -1 : 1;
    patch.normals[wedge] = Vec3f(sums[wedge] * (side / size));
  }
}

/// Drops triangles with equal corners, and the wedges and positions that no triangle uses any more.
void dropUnused(Patch& patch) {
  std::size_t kept = 0;
  for (std::size_t triangle = 0; triangle < patch.elementCount(); ++triangle)
    if (!hasEqualCorners(patch, triangle))
      std::copy_n(&patch.corners[3 * triangle], 3, &patch.corners[3 * kept++]);
  patch.corners.resize(3 * kept);
  const auto renumber = [](std::vector<std::uint32_t>& indices, std::size_t count) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> newIndices(count, none), keptIndices;
    for (std::uint32_t& index : indices) {
      if (newIndices[index] == none) {
        newIndices[index] = static_cast<std::uint32_t>(keptIndices.size());
        keptIndices.push_back(index);
      }
      index = newIndices[index];
    }
    return keptIndices;
  };
  const std::vector<std::uint32_t> wedges = renumber(patch.corners, patch.wedgeCount());
  patch.wedgePositions = gather(patch.wedgePositions, wedges);
  static_cast<VertexAttributes&>(patch) = gather(patch, wedges);
  patch.positions = gather(patch.positions, renumber(patch.wedgePositions, patch.positions.size()));
}

/// The first triangle of a group, for groups of which nothing else would remain.
Patch firstTriangleOf(const Patch& group) {
  Patch patch = group;
  patch.corners.resize(3);
  std::vector<std::uint32_t> wedges = patch.corners;
  patch.corners = {0, 1, 2};
  patch.wedgePositions = {0, 1, 2};
  patch.positions = gather(group.positions, gather(group.wedgePositions, wedges));
  static_cast<VertexAttributes&>(patch) = gather(group, wedges);
  return patch;
}

/// A group without its triangles with equal corners.
Patch properGroup(const Patch& group) {
  Patch patch = group;
  dropUnused(patch);
  return patch;
}

std::vector<Triangle> trianglesForTree(const PatchTriangles& triangles) {
  std::vector<Triangle> result;
  for (std::uint32_t corner = 0; corner < triangles.corners.size(); corner += 3) {
    const auto at = [&](std::uint32_t i) { return Vec3d(triangles.positions[triangles.corners[corner + i]]); };
    result.push_back({at(0), at(1), at(2), corner / 3});
  }
  return result;
}

double shareOf(const SimplifiedTriangles& simplified, const ProperTriangles& proper) {
  return static_cast<double>(simplified.triangles.size()) / static_cast<double>(proper.indices.size());
}

struct SimplifiedGroup {
  SimplifiedTriangles triangles;
  std::vector<bool> isFixed; ///< by position
  bool isOfWholePieces = false;
};

/// A coarser form of a group, of about `count` triangles.
SimplifiedGroup simplifiedGroup(const Patch& group, const ProperTriangles& proper, std::size_t count,
                                const std::vector<bool>& isFixed) {
  const auto simplifyTo = [&](std::size_t triangles) {
    SimplifiedGroup simplified;
    simplified.triangles = simplify(group.positions, proper.corners, isFixed, std::max<std::size_t>(triangles, 1),
                                    CollapseOrder::measured);
    simplified.isFixed = fixedPositions(simplified.triangles, isFixed);
    return simplified;
  };
  const std::size_t all = proper.indices.size();
  if (static_cast<double>(all) <
      minTrianglesOfPiece * static_cast<double>(countPieces(group.positions.size(), proper.corners))) {
    SimplifiedGroup whole = simplifyTo(all);
    whole.isOfWholePieces = true;
    dropPieces(whole.triangles, whole.isFixed, count);
    if (shareOf(whole.triangles, proper) <= maxSimplifiedShare)
      return whole;
  }
  SimplifiedGroup simplified = simplifyTo(count);
  if (shareOf(simplified.triangles, proper) > maxSimplifiedShare)
    dropPieces(simplified.triangles, simplified.isFixed, count);
  return simplified;
}

} // namespace

double coarseError(const PatchTriangles& group, const PatchTriangles& form, bool isOfSource) {
  if (!isOfSource || form.corners.empty())
    return largestDistance(group, form);
  struct Piece {
    Box3d box;
    double distance = 0;
  };
  const TriangleTree tree(trianglesForTree(form));
  DisjointSets sets = piecesOf(group.positions.size(), group.corners);
  std::vector<Piece> pieces(group.positions.size()); // by the position that names its set
  std::vector<bool> isMeasured(group.positions.size());
  for (const std::uint32_t position : group.corners) {
    if (isMeasured[position])
      continue;
    isMeasured[position] = true;
    const Vec3d point(group.positions[position]);
    Piece& piece = pieces[sets.find(position)];
    piece.box.add(point);
    piece.distance = std::max(piece.distance, tree.distance(point));
  }
  double largest = 0;
  for (const Piece& piece : pieces)
    if (piece.distance > 0)
      largest = std::max(largest, std::min(piece.distance, length(piece.box.size())));
  return largest;
}

double largestDistance(const PatchTriangles& from, const PatchTriangles& to) {
  if (to.corners.empty())
    return from.corners.empty() ? 0 : std::numeric_limits<double>::infinity();
  const TriangleTree tree(trianglesForTree(to));
  std::vector<bool> isMeasured(from.positions.size());
  double largest = 0;
  for (const std::uint32_t position : from.corners) {
    if (isMeasured[position])
      continue;
    isMeasured[position] = true;
    largest = std::max(largest, tree.distance(Vec3d(from.positions[position])));
  }
  return largest;
}

CoarseForm coarseFormOf(const Patch& group, const std::vector<bool>& isFixed, const CoarseOptions& options) {
  const ProperTriangles proper(group);
  CoarseForm coarse;
  if (proper.indices.empty())
    return {firstTriangleOf(group), 0};
  const auto count = static_cast<std::size_t>(static_cast<double>(proper.indices.size()) / options.ratio);
  auto [simplified, isFixedHere, isOfWholePieces] = simplifiedGroup(group, proper, count, isFixed);
  if (!isOfWholePieces) // else neighbours would meet at rounded points, and be one piece on the next level
    roundPositions(simplified, isFixedHere, options);
  SimplifiedWedges wedges = wedgesOf(simplified, group, proper.indices, Creases::kept);
  static_cast<VertexAttributes&>(coarse.patch) =
      hasAnyAttribute(group) ? gather(group, wedges.sources) : static_cast<const VertexAttributes&>(group);
  coarse.patch.positions = std::move(simplified.positions);
  coarse.patch.wedgePositions = std::move(wedges.positions);
  coarse.patch.corners = std::move(wedges.corners);
  computeNormals(coarse.patch, isFixedHere);
  dropUnused(coarse.patch);
  if (coarse.patch.corners.empty())
    coarse.patch = properGroup(group);
  coarse.error = coarseError({group.positions, proper.corners}, trianglesOf(coarse.patch), options.isOfSource);
  return coarse;
}

} // namespace imgeo
