#include "prepare/patches.h"

#include "base/parallel.h"
#include "prepare/index_hash_table.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

namespace imgeo {

namespace {

/// The elements of a node of the KD tree, in the source's order: a range of one permutation of all elements.
using Elements = std::span<std::uint32_t>;

/// Centroid and weight of every element.
struct ElementTable {
  const Mesh& mesh;
  std::vector<Vec3f> centroids;
  /// Each wedge distributes a weight of `one` evenly to its elements, so that the weight of a node's elements is about
  /// the number of its wedges. Integers, since their sums do not depend on the order.
  std::vector<std::uint32_t> weights;
  static constexpr std::uint32_t one = 1 << 20;

  explicit ElementTable(const Mesh& source)
      : mesh(source), centroids(source.elementCount()), weights(source.elementCount()) {
    std::vector<std::uint32_t> valences(mesh.wedgeCount(), 0);
    for (const std::uint32_t wedge : mesh.corners)
      ++valences[wedge];
    const std::uint32_t count = cornersPerElement(mesh.topology);
    parallelForBlocks(mesh.elementCount(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t element = begin; element < end; ++element) {
        Vec3d sum;
        for (std::size_t corner = element * count; corner < (element + 1) * count; ++corner) {
          sum += Vec3d(mesh.cornerPosition(corner));
          weights[element] += std::max(1u, one / valences[mesh.corners[corner]]);
        }
        centroids[element] = Vec3f(sum * (1.0 / count));
      }
    });
  }
};

std::size_t countWedges(const Mesh& mesh, Elements elements) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  std::vector<bool> seen(mesh.wedgeCount());
  std::size_t wedges = 0;
  for (const std::uint32_t element : elements)
    for (std::size_t corner = std::size_t{element} * count; corner < (std::size_t{element} + 1) * count; ++corner) {
      wedges += !seen[mesh.corners[corner]];
      seen[mesh.corners[corner]] = true;
    }
  return wedges;
}

Box3d boxOf(const ElementTable& table, Elements elements) {
  Box3d box;
  for (const std::uint32_t element : elements)
    box.add(Vec3d(table.centroids[element]));
  return box;
}

int longestAxis(const Box3d& box) {
  const Vec3d size = box.size();
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Partitions the elements along the longest axis of the box, so that the first group has about `share` of the weight.
/// Each group keeps its order. Returns the size of the first group, at least one and less than all. Linear time: the
/// elements are put into buckets along the axis, and the bucket on the boundary alone is sorted.
std::size_t partitionElements(const ElementTable& table, Elements elements, const Box3d& box, double share) {
  constexpr std::size_t bucketCount = 4096;
  const int axis = longestAxis(box);
  const double extent = box.size()[axis];
  const double scale = extent > std::numeric_limits<float>::min() ? (bucketCount - 1) / extent : 0;
  const auto bucketOf = [&](std::uint32_t element) {
    return static_cast<std::size_t>((table.centroids[element][axis] - box.min[axis]) * scale);
  };
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const float at = table.centroids[a][axis], bt = table.centroids[b][axis];
    return at != bt ? at < bt : a < b;
  };

  std::vector<std::uint64_t> weights(bucketCount);
  for (const std::uint32_t element : elements)
    weights[bucketOf(element)] += table.weights[element];
  const double requestedWeight =
      share * static_cast<double>(std::accumulate(weights.begin(), weights.end(), std::uint64_t{0}));
  std::uint64_t firstWeight = 0;
  std::size_t boundaryBucket = 0;
  while (boundaryBucket + 1 < bucketCount &&
         static_cast<double>(firstWeight + weights[boundaryBucket]) <= requestedWeight)
    firstWeight += weights[boundaryBucket++];

  std::vector<std::uint32_t> inBoundaryBucket;
  std::ranges::copy_if(elements, std::back_inserter(inBoundaryBucket),
                       [&](std::uint32_t element) { return bucketOf(element) == boundaryBucket; });
  std::sort(inBoundaryBucket.begin(), inBoundaryBucket.end(), before);
  std::size_t split = 0; // end of the first group in inBoundaryBucket
  while (split + 1 < inBoundaryBucket.size() &&
         static_cast<double>(firstWeight + table.weights[inBoundaryBucket[split]]) <= requestedWeight)
    firstWeight += table.weights[inBoundaryBucket[split++]];
  // If the first element alone weighs more than the share, it becomes the first group.
  const bool takesOne = firstWeight == 0;
  const std::uint32_t firstOfSecond = inBoundaryBucket[split];
  const auto isInFirstGroup = [&](std::uint32_t element) {
    const std::size_t bucket = bucketOf(element);
    return bucket != boundaryBucket ? bucket < boundaryBucket
                                    : before(element, firstOfSecond) || (takesOne && element == firstOfSecond);
  };
  const auto secondBegin = std::stable_partition(elements.begin(), elements.end(), isInFirstGroup);
  return static_cast<std::size_t>(secondBegin - elements.begin());
}

/// Splits a node in two, or returns it alone where it is small enough.
std::vector<Elements> splitNode(const ElementTable& table, Elements elements, std::size_t maxWedges) {
  const auto ceilDivide = [](std::size_t a, std::size_t b) { return (a + b - 1) / b; };
  const std::size_t cornerCount = elements.size() * cornersPerElement(table.mesh.topology);
  const std::size_t patchCount =
      std::max(ceilDivide(countWedges(table.mesh, elements), maxWedges), ceilDivide(cornerCount, maxPatchCorners));
  if (patchCount <= 1)
    return {elements};
  // A node that needs three patches is split at a third, and not in half, so that patches are well filled.
  const std::size_t firstPatchCount = patchCount / 2;
  const double share = static_cast<double>(firstPatchCount) / static_cast<double>(patchCount);
  const std::size_t cut = partitionElements(table, elements, boxOf(table, elements), share);
  return {elements.first(cut), elements.subspan(cut)};
}

/// The leaves of the KD tree, in its order. The nodes of each depth are split in parallel.
std::vector<Elements> leavesOf(const ElementTable& table, Elements all, std::size_t maxWedges) {
  std::vector<Elements> nodes{all};
  std::vector<bool> fits{false};
  while (std::ranges::find(fits, false) != fits.end()) {
    std::vector<std::vector<Elements>> children(nodes.size());
    parallelFor(nodes.size(), [&](std::size_t i) {
      children[i] = fits[i] ? std::vector{nodes[i]} : splitNode(table, nodes[i], maxWedges);
    });
    nodes.clear();
    fits.clear();
    for (const std::vector<Elements>& ofNode : children)
      for (const Elements elements : ofNode) {
        nodes.push_back(elements);
        fits.push_back(ofNode.size() == 1);
      }
  }
  return nodes;
}

/// Numbers distinct values in the order of their first occurrence.
class FirstUseNumbering {
public:
  explicit FirstUseNumbering(std::size_t capacity) : table_(capacity) { kept.reserve(capacity); }

  std::uint32_t numberOf(std::uint32_t value) {
    // A small cache: most values have occurred recently.
    Recent& recent = recent_[value % recentCount];
    if (recent.value != value || recent.number == IndexHashTable::none)
      recent = {value, find(value)};
    return recent.number;
  }

  std::vector<std::uint32_t> kept;

private:
  struct Recent {
    std::uint32_t value = 0, number = IndexHashTable::none;
  };
  static constexpr std::uint32_t recentCount = 1 << 12;

  std::uint32_t find(std::uint32_t value) {
    const auto next = static_cast<std::uint32_t>(kept.size());
    const std::uint32_t number =
        table_.findOrInsert(mixHash(0, value), next, [&](std::uint32_t i) { return kept[i] == value; });
    if (number == next)
      kept.push_back(value);
    return number;
  }

  IndexHashTable table_;
  std::vector<Recent> recent_{recentCount};
};

Patch makePatch(const Mesh& mesh, const std::vector<Vec3u>& lattice, Elements elements, std::size_t maxWedges) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  const std::size_t capacity = std::min(maxWedges, elements.size() * count);

  Patch patch;
  patch.topology = mesh.topology;
  patch.corners.reserve(elements.size() * count);
  FirstUseNumbering wedges(capacity), positions(capacity);
  for (const std::uint32_t element : elements)
    for (std::size_t corner = std::size_t{element} * count; corner < (std::size_t{element} + 1) * count; ++corner)
      patch.corners.push_back(wedges.numberOf(mesh.corners[corner]));
  patch.wedgePositions.reserve(wedges.kept.size());
  for (const std::uint32_t wedge : wedges.kept)
    patch.wedgePositions.push_back(positions.numberOf(mesh.wedgePositions[wedge]));
  patch.positions = gather(lattice, positions.kept);
  static_cast<VertexAttributes&>(patch) = gather(mesh, wedges.kept);
  return patch;
}

/// The patch that is the whole mesh.
Patch wholePatch(Mesh mesh, std::vector<Vec3u> lattice) {
  Patch patch;
  patch.topology = mesh.topology;
  patch.positions = std::move(lattice);
  patch.wedgePositions = std::move(mesh.wedgePositions);
  patch.corners = std::move(mesh.corners);
  static_cast<VertexAttributes&>(patch) = std::move(static_cast<VertexAttributes&>(mesh));
  return patch;
}

} // namespace

Box3d boxOf(const Patch& patch, const Lattice& lattice) {
  Box3d box;
  if (patch.positions.empty())
    return box;
  Vec3u low = patch.positions[0], high = low;
  for (const Vec3u& position : patch.positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  box.add(lattice.point(low));
  box.add(lattice.point(high));
  return box;
}

PatchedMesh cutIntoPatches(Mesh mesh, const Lattice& lattice, std::uint32_t maxWedges) {
  std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  return cutIntoPatches(std::move(mesh), std::move(points), lattice, maxWedges);
}

PatchedMesh cutIntoPatches(Mesh mesh, std::vector<Vec3u> points, const Lattice& lattice, std::uint32_t maxWedges) {
  assert(maxWedges >= 3);
  PatchedMesh result;
  result.lattice = lattice;
  if (mesh.wedgeCount() <= maxWedges && mesh.corners.size() <= maxPatchCorners) {
    if (mesh.elementCount() > 0)
      result.patches.push_back(wholePatch(std::move(mesh), std::move(points)));
  } else {
    std::vector<std::uint32_t> permutation(mesh.elementCount());
    std::iota(permutation.begin(), permutation.end(), 0u);
    const std::vector<Elements> leaves = leavesOf(ElementTable(mesh), permutation, maxWedges);
    const std::optional<VertexGrid> grid = lattice.bits <= maxGridBits ? findVertexGrid(points) : std::nullopt;
    result.patches.resize(leaves.size());
    parallelFor(leaves.size(), [&](std::size_t i) {
      result.patches[i] = makePatch(mesh, points, leaves[i], maxWedges);
      result.patches[i].grid = grid;
    });
  }
  for (const Patch& patch : result.patches) {
    const Box3d box = boxOf(patch, lattice);
    result.box.add(box.min);
    result.box.add(box.max);
  }
  return result;
}

} // namespace imgeo
