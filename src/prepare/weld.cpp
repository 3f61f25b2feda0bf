#include "prepare/weld.h"

#include "base/parallel.h"
#include "prepare/incidence.h"
#include "prepare/index_hash_table.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>

namespace imgeo {

namespace {

/// The bits by which values are compared: -0 counts as 0, and a NaN equals itself.
std::uint32_t keyOf(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0f);
}
std::uint64_t keyOf(Vec2f v) {
  return std::uint64_t{keyOf(v.x)} << 32 | keyOf(v.y);
}

bool haveSameBits(const Vec3f& a, const Vec3f& b) {
  return keyOf(a.x) == keyOf(b.x) && keyOf(a.y) == keyOf(b.y) && keyOf(a.z) == keyOf(b.z);
}
bool haveSameBits(const Rgba& a, const Rgba& b) {
  return keyOf(a.r) == keyOf(b.r) && keyOf(a.g) == keyOf(b.g) && keyOf(a.b) == keyOf(b.b) && keyOf(a.a) == keyOf(b.a);
}
template <typename Value> bool haveSameBits(const Value& a, const Value& b) {
  return keyOf(a) == keyOf(b);
}
std::uint64_t hashOf(std::uint64_t seed, const Vec3f& v) {
  return mixHash(mixHash(seed, keyOf(Vec2f{v.x, v.y})), keyOf(v.z));
}
std::uint64_t hashOf(std::uint64_t seed, const Rgba& c) {
  return mixHash(mixHash(seed, keyOf(Vec2f{c.r, c.g})), keyOf(Vec2f{c.b, c.a}));
}
template <typename Value> std::uint64_t hashOf(std::uint64_t seed, const Value& value) {
  return mixHash(seed, keyOf(value));
}

/// New indices for positions or wedges, in the order of first use.
struct Renumbering {
  std::vector<std::uint32_t> newOf; ///< old -> new; IndexHashTable::none if unused
  std::vector<std::uint32_t> kept;  ///< new -> the first old index
  std::size_t merged = 0;

  explicit Renumbering(std::size_t oldCount) : newOf(oldCount, IndexHashTable::none) {}

  template <typename Equals>
  std::uint32_t findOrAdd(std::uint32_t old, IndexHashTable& table, std::uint64_t hash, Equals equals) {
    const auto next = static_cast<std::uint32_t>(kept.size());
    const std::uint32_t found = table.findOrInsert(hash, next, [&](std::uint32_t i) { return equals(kept[i]); });
    if (found == next)
      kept.push_back(old);
    else
      ++merged;
    return newOf[old] = found;
  }
};

/// The values of an attribute at a vertex.
std::span<const float> valuesOf(const NamedAttribute& attribute, std::uint32_t vertex) {
  return std::span(attribute.values).subspan(std::size_t{vertex} * attribute.components, attribute.components);
}

/// For each position the index of the first equal position. Visits positions in memory order, so that hash slots can be
/// prefetched: with a large table most of the time is memory latency.
std::vector<std::uint32_t> firstEqualPositions(const std::vector<Vec3f>& positions) {
  constexpr std::size_t ahead = 16;
  IndexHashTable table(positions.size());
  std::vector<std::uint32_t> first(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (i + ahead < positions.size())
      table.prefetch(hashOf(0, positions[i + ahead]));
    first[i] = table.findOrInsert(hashOf(0, positions[i]), i,
                                  [&](std::uint32_t other) { return haveSameBits(positions[other], positions[i]); });
  }
  return first;
}

Renumbering weldPositions(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = firstEqualPositions(mesh.positions);
  std::vector<std::uint32_t> newOfFirst(mesh.positions.size(), IndexHashTable::none);
  Renumbering renumbering(mesh.positions.size());
  for (const std::uint32_t wedge : mesh.corners) {
    const std::uint32_t old = mesh.wedgePositions[wedge];
    if (renumbering.newOf[old] != IndexHashTable::none)
      continue;
    std::uint32_t& newIndex = newOfFirst[first[old]];
    if (newIndex == IndexHashTable::none) {
      newIndex = static_cast<std::uint32_t>(renumbering.kept.size());
      renumbering.kept.push_back(old);
    } else {
      ++renumbering.merged;
    }
    renumbering.newOf[old] = newIndex;
  }
  return renumbering;
}

/// Welds wedges of a mesh in which wedges are equal if and only if their positions are, as in most scans. Positions
/// have been welded and are in the order of first use.
Renumbering weldPlainWedges(const Mesh& mesh) {
  Renumbering renumbering(mesh.wedgeCount());
  for (const std::uint32_t old : mesh.corners) {
    if (renumbering.newOf[old] != IndexHashTable::none)
      continue;
    const std::uint32_t position = mesh.wedgePositions[old];
    renumbering.newOf[old] = position;
    if (position == renumbering.kept.size())
      renumbering.kept.push_back(old);
    else
      ++renumbering.merged;
  }
  return renumbering;
}

/// `mesh.wedgePositions` must refer to welded positions, of which there are `positionCount`, for all wedges in use.
Renumbering weldWedges(const Mesh& mesh, std::size_t positionCount) {
  if (!hasAnyAttribute(mesh) || mesh.wedgeCount() == positionCount) // each wedge has a position of its own
    return weldPlainWedges(mesh);
  Renumbering renumbering(mesh.wedgeCount());
  IndexHashTable table(mesh.wedgeCount());
  const auto hash = [&](std::uint32_t w) {
    std::uint64_t result = mixHash(0, mesh.wedgePositions[w]);
    visitAttributes(mesh, [&](const auto&, const auto& values) {
      if (!values.empty())
        result = hashOf(result, values[w]);
    });
    for (const NamedAttribute& attribute : mesh.namedAttributes)
      for (const float value : valuesOf(attribute, w))
        result = mixHash(result, keyOf(value));
    return result;
  };
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    if (mesh.wedgePositions[a] != mesh.wedgePositions[b])
      return false;
    bool isSame = true;
    visitAttributes(mesh, [&](const auto&, const auto& values) {
      isSame = isSame && (values.empty() || haveSameBits(values[a], values[b]));
    });
    return isSame && std::ranges::all_of(mesh.namedAttributes, [&](const NamedAttribute& attribute) {
             return std::ranges::equal(
                 valuesOf(attribute, a), valuesOf(attribute, b), {}, [](float value) { return keyOf(value); },
                 [](float value) { return keyOf(value); });
           });
  };
  for (const std::uint32_t old : mesh.corners)
    if (renumbering.newOf[old] == IndexHashTable::none)
      renumbering.findOrAdd(old, table, hash(old), [&](std::uint32_t other) { return equal(old, other); });
  return renumbering;
}

/// An element's corners, rotated to the lexicographically smallest sequence; lines are sorted.
Vec3u canonicalCorners(const std::uint32_t* corners, std::uint32_t count) {
  if (count == 1)
    return {corners[0], 0, 0};
  if (count == 2)
    return {std::min(corners[0], corners[1]), std::max(corners[0], corners[1]), 0};
  const auto [a, b, c] = std::array{corners[0], corners[1], corners[2]};
  // If the minimum occurs twice, the sequence begins with both.
  if (a <= b && a < c)
    return {a, b, c};
  if (b <= c && b < a)
    return {b, c, a};
  return {c, a, b};
}

/// An element's canonical corners without the first.
struct OtherCorners {
  std::uint64_t corners;
  std::uint32_t element;

  auto operator<=>(const OtherCorners&) const = default;
};

/// Marks the elements that repeat an earlier one. `others` are the elements with one first canonical corner, in
/// ascending order.
void markRepeated(std::vector<OtherCorners>& others, std::vector<std::uint8_t>& repeated) {
  constexpr std::size_t maxPairwiseCount = 8; // up to this number comparing all pairs is faster than sorting
  if (others.size() > maxPairwiseCount)
    std::sort(others.begin(), others.end());
  for (std::size_t i = 1; i < others.size(); ++i)
    for (std::size_t j = others.size() > maxPairwiseCount ? i - 1 : 0; j < i; ++j)
      if (others[j].corners == others[i].corners)
        repeated[others[i].element] = 1;
}

/// By element: 1 if it repeats an earlier one, else 0. An element is compared with the few elements that have the same
/// first canonical corner.
std::vector<std::uint8_t> findRepeated(const Mesh& mesh) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  const auto cornersOf = [&](std::size_t element) {
    return canonicalCorners(mesh.corners.data() + element * count, count);
  };
  std::vector<std::uint32_t> firstCorner(mesh.elementCount());
  parallelForBlocks(firstCorner.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t element = begin; element < end; ++element)
      firstCorner[element] = cornersOf(element).x;
  });
  const Incidence byFirstCorner =
      incidenceOf(firstCorner.size(), mesh.wedgeCount(), [&](std::size_t element) { return firstCorner[element]; });
  std::vector<std::uint8_t> repeated(mesh.elementCount());
  parallelForBlocks(mesh.wedgeCount(), [&](std::size_t begin, std::size_t end) {
    std::vector<OtherCorners> others;
    for (std::size_t first = begin; first < end; ++first) {
      others.clear();
      for (const std::uint32_t element : byFirstCorner.of(static_cast<std::uint32_t>(first))) {
        const Vec3u corners = cornersOf(element);
        others.push_back({std::uint64_t{corners.y} << 32 | corners.z, element});
      }
      markRepeated(others, repeated);
    }
  });
  return repeated;
}

/// By element: 1 if two of its corners have the same position, else 0.
std::vector<std::uint8_t> findDegenerate(const Mesh& mesh) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  std::vector<std::uint8_t> degenerate(mesh.elementCount());
  parallelForBlocks(count > 1 ? mesh.elementCount() : 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t element = begin; element < end; ++element) {
      const auto positionOf = [&](std::size_t i) { return mesh.wedgePositions[mesh.corners[element * count + i]]; };
      degenerate[element] = positionOf(0) == positionOf(1) ||
                            (count > 2 && (positionOf(1) == positionOf(2) || positionOf(2) == positionOf(0)));
    }
  });
  return degenerate;
}

std::size_t countOf(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
}

/// Removes the marked elements. Returns whether there were any.
bool removeMarkedElements(Mesh& mesh, const std::vector<std::uint8_t>& marks) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  auto end = mesh.corners.begin();
  for (std::size_t element = 0; element < marks.size(); ++element)
    if (!marks[element])
      end = std::copy_n(mesh.corners.begin() + static_cast<std::ptrdiff_t>(element * count), count, end);
  const bool isAny = end != mesh.corners.end();
  mesh.corners.erase(end, mesh.corners.end());
  return isAny;
}

/// Counts degenerate and repeated elements of a welded mesh, and removes those of the kinds in `dropped`.
void removeElements(Mesh& mesh, const DroppedElements& dropped, WeldReport& report) {
  const std::vector<std::uint8_t> degenerate = findDegenerate(mesh), repeated = findRepeated(mesh);
  report.degenerateElements = countOf(degenerate);
  report.duplicateElements = countOf(repeated);
  std::vector<std::uint8_t> marks(mesh.elementCount());
  for (std::size_t element = 0; element < marks.size(); ++element)
    marks[element] = (dropped.degenerate && degenerate[element]) || (dropped.repeated && repeated[element]);
  if (removeMarkedElements(mesh, marks))
    report.unreferencedPositions += weld(mesh).unreferencedPositions;
}

} // namespace

WeldReport weld(Mesh& mesh, const DroppedElements& dropped) {
  WeldReport report;
  const Renumbering positions = weldPositions(mesh);
  report.mergedPositions = positions.merged;
  report.unreferencedPositions = mesh.positions.size() - positions.kept.size() - positions.merged;
  mesh.positions = gather(mesh.positions, positions.kept);
  for (std::uint32_t& position : mesh.wedgePositions)
    position = positions.newOf[position];

  const Renumbering wedges = weldWedges(mesh, positions.kept.size());
  report.mergedWedges = wedges.merged;
  mesh.wedgePositions = gather(mesh.wedgePositions, wedges.kept);
  static_cast<VertexAttributes&>(mesh) = gather(mesh, wedges.kept);
  parallelForBlocks(mesh.corners.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t corner = begin; corner < end; ++corner)
      mesh.corners[corner] = wedges.newOf[mesh.corners[corner]];
  });

  removeElements(mesh, dropped, report);
  return report;
}

} // namespace imgeo
