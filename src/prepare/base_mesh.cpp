#include "prepare/base_mesh.h"

#include "base/parallel.h"
#include "prepare/base_wedges.h"
#include "prepare/edge_sum.h"
#include "prepare/position_table.h"
#include "prepare/simplify.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <span>
#include <utility>

namespace imgeo {

namespace {

/// The positions of all patches as indices into a common table, and which of them several patches share.
struct CommonPositions {
  std::vector<std::vector<std::uint32_t>> indices; ///< by patch and position
  std::vector<bool> isShared;                      ///< by common index
};

template <typename AnyPatch>
CommonPositions commonPositions(const std::vector<AnyPatch>& patches, PositionTable& table) {
  CommonPositions common;
  std::vector<std::uint32_t> firstPatches; // by common index
  for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
    const std::vector<Vec3u>& positions = patches[patch].positions;
    std::vector<std::uint32_t>& indices = common.indices.emplace_back();
    indices.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      constexpr std::size_t ahead = 16; // with a large table most of the time is memory latency
      if (i + ahead < positions.size())
        table.prefetch(positions[i + ahead]);
      const std::uint32_t index = table.indexOf(positions[i]);
      if (index == firstPatches.size()) {
        firstPatches.push_back(patch);
        common.isShared.push_back(false);
      }
      common.isShared[index] = common.isShared[index] || firstPatches[index] != patch;
      indices.push_back(index);
    }
  }
  return common;
}

template <typename AnyPatch> std::size_t positionCountOf(const std::vector<AnyPatch>& patches) {
  std::size_t count = 0;
  for (const AnyPatch& patch : patches)
    count += patch.positions.size();
  return count;
}

/// By patch and position: whether another patch has the position, too.
std::vector<std::vector<bool>> sharedPositions(const std::vector<Patch>& patches) {
  if (patches.size() == 1)
    return {std::vector<bool>(patches[0].positions.size())};
  PositionTable table(positionCountOf(patches));
  const CommonPositions common = commonPositions(patches, table);
  std::vector<std::vector<bool>> isShared;
  for (const std::vector<std::uint32_t>& indices : common.indices) {
    std::vector<bool>& ofPatch = isShared.emplace_back(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      ofPatch[i] = common.isShared[indices[i]];
  }
  return isShared;
}

/// By position: the first one at the same lattice point. Positions that differ in the source may share one.
std::vector<std::uint32_t> firstPositions(const std::vector<Vec3u>& positions) {
  PositionTable table(positions.size());
  std::vector<std::uint32_t> firsts, firstOf; // by lattice point, by position
  firstOf.reserve(positions.size());
  for (std::uint32_t position = 0; position < positions.size(); ++position) {
    const std::uint32_t point = table.indexOf(positions[position]);
    if (point == firsts.size())
      firsts.push_back(position);
    firstOf.push_back(firsts[point]);
  }
  return firstOf;
}

/// The non-degenerate triangles of a patch: their corners as the first positions at their lattice points, and their
/// indices in the patch.
struct NonDegenerateTriangles {
  std::vector<std::uint32_t> corners, indices;
};

NonDegenerateTriangles nonDegenerateTrianglesOf(const Patch& patch, const std::vector<std::uint32_t>& firstOf) {
  NonDegenerateTriangles triangles;
  triangles.corners.reserve(patch.corners.size());
  triangles.indices.reserve(patch.elementCount());
  for (std::size_t corner = 0; corner < patch.corners.size(); corner += 3) {
    const auto positionOf = [&](std::size_t i) { return firstOf[patch.wedgePositions[patch.corners[corner + i]]]; };
    const std::uint32_t a = positionOf(0), b = positionOf(1), c = positionOf(2);
    if (a == b || b == c || c == a)
      continue;
    triangles.corners.insert(triangles.corners.end(), {a, b, c});
    triangles.indices.push_back(static_cast<std::uint32_t>(corner / 3));
  }
  return triangles;
}

double areaOf(const std::vector<Vec3u>& positions, const std::vector<std::uint32_t>& corners) {
  double area = 0;
  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    const Vec3d a(positions[corners[corner]]), b(positions[corners[corner + 1]]), c(positions[corners[corner + 2]]);
    area += length(cross(b - a, c - a)) / 2;
  }
  return area;
}

/// A segment of a base mesh before it is joined to the others.
struct Segment {
  std::vector<Vec3u> positions;
  SimplifiedWedges wedges;
  double area = 0, inputArea = 0;
  std::size_t inputTriangleCount = 0;
};

/// Counts the border edges between fixed positions, which simplification keeps.
std::size_t countFixedEdges(const std::vector<std::uint32_t>& corners, const std::vector<bool>& isFixed) {
  if (std::ranges::find(isFixed, true) == isFixed.end())
    return 0;
  EdgeSum border;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const std::uint32_t from = corners[corner], to = corners[corner % 3 == 2 ? corner - 2 : corner + 1];
    if (isFixed[from] && isFixed[to])
      border.add(from, to);
  }
  std::size_t count = 0;
  border.visit([&](std::uint32_t, std::uint32_t, int) { ++count; });
  return count;
}

Segment segmentOf(const Patch& patch, const std::vector<bool>& isFixed, double percent) {
  // Positions at one lattice point are one vertex, else simplification would tear them apart.
  const std::vector<std::uint32_t> firstOf = firstPositions(patch.positions);
  const auto [corners, triangleIndices] = nonDegenerateTrianglesOf(patch, firstOf);
  Segment segment;
  segment.inputTriangleCount = corners.size() / 3;
  // The interior gets at least half of the requested triangles, beside those that fixed border edges need.
  const double requested = percent / 100 * static_cast<double>(segment.inputTriangleCount);
  const double minimum = requested / 2 + static_cast<double>(countFixedEdges(corners, isFixed));
  SimplifiedTriangles triangles =
      simplify(patch.positions, corners, isFixed, static_cast<std::size_t>(std::max(requested, minimum)));
  for (std::size_t position = 0; position < firstOf.size(); ++position) // those before have their vertex already
    triangles.vertexOfInput[position] = triangles.vertexOfInput[firstOf[position]];
  segment.inputArea = triangles.inputArea;
  segment.area = areaOf(triangles.positions, triangles.corners);
  segment.wedges = wedgesOf(triangles, patch, triangleIndices);
  segment.positions = std::move(triangles.positions);
  return segment;
}

/// Joins segments: equal positions of several segments become one, and so do wedges of equal position and texture
/// coordinates.
class SegmentJoiner {
public:
  explicit SegmentJoiner(const std::vector<Segment>& segments)
      : positions_(countOf(segments, [](const Segment& segment) { return segment.positions.size(); })),
        wedges_(countOf(segments, [](const Segment& segment) { return segment.wedges.positions.size(); })) {
    base_.segmentCount = static_cast<std::uint32_t>(segments.size());
  }

  void add(const Segment& segment, const Patch& patch, std::uint32_t segmentIndex) {
    const std::size_t wedgeCountBefore = base_.wedgePositions.size();
    std::vector<std::uint32_t> wedges, sources;
    for (std::size_t wedge = 0; wedge < segment.wedges.positions.size(); ++wedge) {
      const std::uint32_t source = segment.wedges.sources[wedge];
      const std::uint32_t position = positions_.indexOf(segment.positions[segment.wedges.positions[wedge]]);
      wedges.push_back(wedgeAt(position, texCoordBitsOf(patch, source)));
      if (wedgeCountBefore + sources.size() < base_.wedgePositions.size())
        sources.push_back(source);
    }
    VertexAttributes attributes = gather(patch, sources);
    visitAttributes(attributes, [](const auto& row, auto& values) {
      if (!isInBase(row.role))
        values.clear();
    });
    append(base_, wedgeCountBefore, attributes, sources.size());
    for (std::size_t corner = 0; corner < segment.wedges.corners.size(); corner += 3) {
      const auto wedgeOf = [&](std::size_t i) { return wedges[segment.wedges.corners[corner + i]]; };
      const std::uint32_t a = base_.wedgePositions[wedgeOf(0)], b = base_.wedgePositions[wedgeOf(1)],
                          c = base_.wedgePositions[wedgeOf(2)];
      if (a == b || b == c || c == a)
        continue;
      base_.corners.insert(base_.corners.end(), {wedgeOf(0), wedgeOf(1), wedgeOf(2)});
      base_.segments.push_back(segmentIndex);
    }
  }

  BaseMesh finish() {
    base_.positions = std::move(positions_.positions);
    return std::move(base_);
  }

private:
  template <typename Count> static std::size_t countOf(const std::vector<Segment>& segments, Count countIn) {
    std::size_t count = 0;
    for (const Segment& segment : segments)
      count += countIn(segment);
    return count;
  }

  /// u and v in each set; 0 in absent ones.
  using TexCoordBits = std::array<std::uint64_t, maxTexCoordSets>;

  static TexCoordBits texCoordBitsOf(const Patch& patch, std::uint32_t wedge) {
    TexCoordBits bits{};
    for (std::size_t set = 0; set < texCoordSetCount(patch); ++set) {
      const Vec2f texCoord = texCoordsOf(patch, set)[wedge];
      bits[set] =
          std::uint64_t{std::bit_cast<std::uint32_t>(texCoord.x)} << 32 | std::bit_cast<std::uint32_t>(texCoord.y);
    }
    return bits;
  }

  std::uint32_t wedgeAt(std::uint32_t position, const TexCoordBits& bits) {
    const auto next = static_cast<std::uint32_t>(base_.wedgePositions.size());
    std::uint64_t hash = mixHash(0, position);
    for (const std::uint64_t each : bits)
      hash = mixHash(hash, each);
    const std::uint32_t wedge = wedges_.findOrInsert(
        hash, next, [&](std::uint32_t i) { return base_.wedgePositions[i] == position && texCoordBits_[i] == bits; });
    if (wedge == next) {
      base_.wedgePositions.push_back(position);
      texCoordBits_.push_back(bits);
    }
    return wedge;
  }

  BaseMesh base_;
  PositionTable positions_;
  IndexHashTable wedges_;
  std::vector<TexCoordBits> texCoordBits_; ///< by wedge
};

/// Renumbers `indices`, all below `count`, in the order of their first occurrence. Returns the old index of each new
/// one.
std::vector<std::uint32_t> renumberByFirstUse(std::vector<std::uint32_t>& indices, std::size_t count) {
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> newIndices(count, none), kept;
  for (std::uint32_t& index : indices) {
    if (newIndices[index] == none) {
      newIndices[index] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(index);
    }
    index = newIndices[index];
  }
  return kept;
}

/// Removes wedges and positions that no triangle uses.
void removeUnused(BaseMesh& base) {
  const std::vector<std::uint32_t> wedges = renumberByFirstUse(base.corners, base.wedgePositions.size());
  base.wedgePositions = gather(base.wedgePositions, wedges);
  static_cast<VertexAttributes&>(base) = gather(base, wedges);
  base.positions = gather(base.positions, renumberByFirstUse(base.wedgePositions, base.positions.size()));
}

} // namespace

std::optional<BaseMesh> baseOf(const PatchedMesh& mesh, double percent) {
  std::size_t elementCount = 0;
  for (const Patch& patch : mesh.patches)
    elementCount += patch.elementCount();
  if (mesh.patches.empty() || mesh.patches[0].topology != Topology::triangles || elementCount < minTrianglesForBase ||
      !(percent > 0))
    return std::nullopt;
  const std::vector<std::vector<bool>> isFixed = sharedPositions(mesh.patches);
  std::vector<Segment> segments(mesh.patches.size());
  parallelFor(segments.size(), [&](std::size_t i) { segments[i] = segmentOf(mesh.patches[i], isFixed[i], percent); });
  double inputArea = 0, area = 0;
  for (const Segment& segment : segments) {
    inputArea += segment.inputArea;
    area += segment.area;
  }
  SegmentJoiner joiner(segments);
  for (std::uint32_t i = 0; i < segments.size(); ++i)
    joiner.add(segments[i], mesh.patches[i], i);
  BaseMesh base = joiner.finish();
  removeUnused(base);
  if (4 * base.triangleCount() > elementCount || 2 * area < inputArea || base.corners.empty())
    return std::nullopt;
  return base;
}

PatchTriangles trianglesOf(const Patch& patch) {
  return {patch.positions, nonDegenerateTrianglesOf(patch, firstPositions(patch.positions)).corners};
}

bool meetsAtBorders(const BaseMesh& base, const std::vector<PatchTriangles>& patches) {
  if (base.segmentCount != patches.size())
    return false;
  PositionTable table(positionCountOf(patches) + base.positions.size());
  const CommonPositions common = commonPositions(patches, table);
  std::vector<std::uint32_t> baseIndices;
  for (const Vec3u& position : base.positions)
    baseIndices.push_back(table.indexOf(position));
  std::vector<EdgeSum> differences(patches.size());
  for (std::size_t triangle = 0; triangle < base.triangleCount(); ++triangle)
    differences[base.segments[triangle]].addTriangles(
        std::span(base.corners).subspan(3 * triangle, 3),
        [&](std::uint32_t wedge) { return baseIndices[base.wedgePositions[wedge]]; });
  bool meets = true;
  for (std::size_t segment = 0; segment < patches.size(); ++segment) {
    EdgeSum border;
    border.addTriangles(patches[segment].corners,
                        [&](std::uint32_t position) { return common.indices[segment][position]; });
    // Simplification maps each edge of the mesh's border, which no other patch shares, to one edge or to none.
    std::size_t borderEdgeCount = 0, changedEdgeCount = 0;
    border.visit([&](std::uint32_t a, std::uint32_t b, int count) {
      if (common.isShared[a] && common.isShared[b])
        differences[segment].add(a, b, -count);
      else
        borderEdgeCount += static_cast<std::size_t>(std::abs(count));
    });
    differences[segment].visit([&](std::uint32_t, std::uint32_t, int count) {
      changedEdgeCount += static_cast<std::size_t>(std::abs(count));
    });
    meets = meets && changedEdgeCount <= borderEdgeCount;
  }
  return meets;
}

} // namespace imgeo
