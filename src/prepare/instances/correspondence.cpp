#include "prepare/instances/correspondence.h"

#include "prepare/instances/point_index.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace imgeo {

namespace {

/// Compares the attributes of wedges of two meshes.
class WedgeComparison {
public:
  WedgeComparison(const Mesh& from, const Mesh& to, const Affine3d& map, double tolerance)
      : from_(from), to_(to), map_(map), tolerance_(tolerance) {}

  bool areEqual(std::uint32_t wedge, std::uint32_t other) {
    bool equal = true;
    visitAttributes(from_, to_, [&](const auto& row, const auto& values, const auto& others) {
      if (!values.empty() && row.role != VertexRole::normal)
        equal = equal && values[wedge] == others[other];
    });
    for (std::size_t i = 0; equal && i < from_.namedAttributes.size(); ++i) {
      const NamedAttribute &a = from_.namedAttributes[i], &b = to_.namedAttributes[i];
      equal = std::equal(a.values.begin() + wedge * std::ptrdiff_t{a.components},
                         a.values.begin() + (wedge + std::ptrdiff_t{1}) * a.components,
                         b.values.begin() + other * std::ptrdiff_t{b.components});
    }
    if (!equal || from_.normals.empty())
      return equal;
    const double difference = length(map_.direction(Vec3d(from_.normals[wedge])) - Vec3d(to_.normals[other]));
    if (!(difference <= tolerance_))
      return false;
    largest_ = std::max(largest_, difference);
    return true;
  }
  double largest() const { return largest_; }

private:
  const Mesh &from_, &to_;
  const Affine3d& map_;
  double tolerance_;
  double largest_ = 0;
};

/// An element by its positions, of triangles the smallest first.
struct ElementKey {
  std::array<std::uint32_t, 3> positions{};
  std::array<std::uint32_t, 3> wedges{};
};

ElementKey keyOf(const Mesh& mesh, std::size_t element, const std::vector<std::uint32_t>* positions) {
  const std::size_t count = cornersPerElement(mesh.topology);
  ElementKey key;
  for (std::size_t i = 0; i < count; ++i) {
    key.wedges[i] = mesh.corners[count * element + i];
    const std::uint32_t position = mesh.wedgePositions[key.wedges[i]];
    key.positions[i] = positions ? (*positions)[position] : position;
  }
  if (count == 3) {
    const auto first = std::ranges::min_element(key.positions) - key.positions.begin();
    std::ranges::rotate(key.wedges, key.wedges.begin() + first);
    std::ranges::rotate(key.positions, key.positions.begin() + first);
  }
  return key;
}

bool haveSameOrder(const Mesh& a, const Mesh& b) {
  return a.wedgePositions == b.wedgePositions && a.corners == b.corners;
}

std::optional<Correspondence> inOrder(const Mesh& from, const Mesh& to, const Affine3d& map,
                                      const CongruenceTolerance& tolerance) {
  Correspondence result;
  for (std::size_t i = 0; i < from.positions.size(); ++i) {
    const double distance = length(map.point(Vec3d(from.positions[i])) - Vec3d(to.positions[i]));
    if (!(distance <= tolerance.distance))
      return std::nullopt;
    result.distance = std::max(result.distance, distance);
  }
  WedgeComparison wedges(from, to, map, tolerance.normal);
  for (std::uint32_t wedge = 0; wedge < from.wedgeCount(); ++wedge)
    if (!wedges.areEqual(wedge, wedge))
      return std::nullopt;
  result.normal = wedges.largest();
  for (std::uint32_t i = 0; i < from.positions.size(); ++i)
    result.positions.push_back(i);
  return result;
}

/// Pairs positions with the nearest ones, each once.
std::optional<Correspondence> pairPositions(const Mesh& from, const Mesh& to, const Affine3d& map, double tolerance) {
  const PointIndex index(to.positions, tolerance);
  Correspondence result;
  std::vector<bool> isTaken(to.positions.size());
  for (const Vec3f& position : from.positions) {
    const auto found = index.nearest(map.point(Vec3d(position)));
    if (!found || isTaken[found->index])
      return std::nullopt;
    isTaken[found->index] = true;
    result.positions.push_back(found->index);
    result.distance = std::max(result.distance, found->distance);
  }
  return result;
}

bool pairElements(const Mesh& from, const Mesh& to, const std::vector<std::uint32_t>& positions,
                  WedgeComparison& wedges) {
  std::vector<ElementKey> others;
  for (std::size_t element = 0; element < to.elementCount(); ++element)
    others.push_back(keyOf(to, element, nullptr));
  std::ranges::sort(others, {}, [](const ElementKey& key) { return std::tie(key.positions, key.wedges); });
  std::vector<bool> isTaken(others.size());
  const std::size_t corners = cornersPerElement(from.topology);
  for (std::size_t element = 0; element < from.elementCount(); ++element) {
    const ElementKey key = keyOf(from, element, &positions);
    const auto equal = std::ranges::equal_range(others, key.positions, {}, &ElementKey::positions);
    const auto found = std::ranges::find_if(equal, [&](const ElementKey& other) {
      if (isTaken[static_cast<std::size_t>(&other - others.data())])
        return false;
      for (std::size_t i = 0; i < corners; ++i)
        if (!wedges.areEqual(key.wedges[i], other.wedges[i]))
          return false;
      return true;
    });
    if (found == equal.end())
      return false;
    isTaken[static_cast<std::size_t>(&*found - others.data())] = true;
  }
  return true;
}

} // namespace

bool haveSameCounts(const Mesh& a, const Mesh& b) {
  bool same = a.topology == b.topology && a.positions.size() == b.positions.size() &&
              a.wedgeCount() == b.wedgeCount() && a.corners.size() == b.corners.size() &&
              a.colorComponents == b.colorComponents && a.texCoordMappings == b.texCoordMappings &&
              a.namedAttributes.size() == b.namedAttributes.size();
  visitAttributes(a, b, [&](const auto&, const auto& values, const auto& others) {
    same = same && values.empty() == others.empty();
  });
  for (std::size_t i = 0; same && i < a.namedAttributes.size(); ++i)
    same = a.namedAttributes[i].name == b.namedAttributes[i].name &&
           a.namedAttributes[i].components == b.namedAttributes[i].components;
  return same;
}

std::optional<Correspondence> correspondence(const Mesh& from, const Mesh& to, const Affine3d& map,
                                             const CongruenceTolerance& tolerance) {
  if (!haveSameCounts(from, to))
    return std::nullopt;
  if (haveSameOrder(from, to))
    if (auto result = inOrder(from, to, map, tolerance))
      return result;
  std::optional<Correspondence> result = pairPositions(from, to, map, tolerance.distance);
  if (!result)
    return std::nullopt;
  WedgeComparison wedges(from, to, map, tolerance.normal);
  if (!pairElements(from, to, result->positions, wedges))
    return std::nullopt;
  result->normal = wedges.largest();
  return result;
}

} // namespace imgeo
