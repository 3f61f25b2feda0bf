#include "prepare/instances/find_instances.h"

#include "base/parallel.h"
#include "prepare/index_hash_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace imgeo {

namespace {

constexpr std::size_t maxComparisons = 32;

/// The number of a logarithmic cell, whose width is more than the largest share of a radius that may differ.
std::int64_t cellOf(double size) {
  constexpr double cellsPerDoubling = 256;
  return size > 0 ? static_cast<std::int64_t>(std::floor(std::log2(size) * cellsPerDoubling)) : INT64_MIN / 2;
}

/// A hash of the coordinates in their order.
std::uint64_t coordinateHashOf(const Mesh& mesh) {
  std::uint64_t hash = 1;
  for (const Vec3f& position : mesh.positions)
    for (int axis = 0; axis < 3; ++axis)
      hash = mixHash(hash, std::bit_cast<std::uint32_t>(position[axis]));
  return hash;
}

/// The meshes of one kind with the same content, by their sizes.
class Class {
public:
  Class(const SceneMeshes& meshes, const std::vector<MeshMeasure>& measures, const std::vector<double>& tolerances)
      : meshes_(meshes), measures_(measures), tolerances_(tolerances) {}

  /// An instance of an earlier mesh; otherwise the mesh is one of them from now on.
  std::optional<MeshInstance> add(std::size_t mesh) {
    const MeshMeasure& measure = measures_[mesh];
    const Cell cell{cellOf(measure.radius), cellOf(measure.gyration)};
    std::vector<std::size_t> candidates;
    for (std::int64_t radius = cell.first - 1; radius <= cell.first + 1; ++radius)
      for (std::int64_t gyration = cell.second - 1; gyration <= cell.second + 1; ++gyration)
        if (const auto found = earlier_.find({radius, gyration}); found != earlier_.end())
          candidates.insert(candidates.end(), found->second.begin(), found->second.end());
    std::ranges::sort(candidates, {}, [&](std::size_t candidate) { return numbers_.at(candidate); });
    std::size_t comparisons = 0;
    std::optional<MeshHandle> own;
    for (const std::size_t candidate : candidates) {
      const MeshMeasure& other = measures_[candidate];
      const CongruenceTolerance tolerance{
          congruenceDistance(std::min(tolerances_[mesh], tolerances_[candidate]), other, measure)};
      if (!mayBeCongruent(other, measure, tolerance.distance))
        continue;
      if (!own)
        own.emplace(meshes_[mesh]);
      const MeshHandle earlier = meshes_[candidate];
      if (const auto transform = findRigidMap(*earlier, other, **own, measure, tolerance))
        return MeshInstance{candidate, *transform,
                            correspondence(*earlier, **own, affineOf(*transform), tolerance).value().distance};
      if (++comparisons == maxComparisons)
        break;
    }
    numbers_.emplace(mesh, numbers_.size());
    earlier_[cell].push_back(mesh);
    return std::nullopt;
  }

private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  const SceneMeshes& meshes_;
  const std::vector<MeshMeasure>& measures_;
  const std::vector<double>& tolerances_;
  std::map<Cell, std::vector<std::size_t>> earlier_;     ///< meshes that stand for themselves
  std::unordered_map<std::size_t, std::size_t> numbers_; ///< the order in which they came
};

} // namespace

double congruenceDistance(double tolerance, const MeshMeasure& a, const MeshMeasure& b) {
  const double rounding = std::ldexp(a.largestCoordinate + b.largestCoordinate, -23);
  return tolerance + std::min(rounding, std::min(a.radius, b.radius) / 1024);
}

std::vector<std::optional<MeshInstance>> findInstances(const SceneMeshes& meshes, const InstanceSearch& search) {
  const auto isUnmoved = [&](std::size_t mesh) { return !search.unmoved.empty() && search.unmoved[mesh]; };
  std::vector<MeshMeasure> measures(meshes.size());
  std::vector<double> tolerances(meshes.size());
  std::vector<std::uint64_t> coordinateHashes(meshes.size());
  parallelFor(meshes.size(), [&](std::size_t i) {
    if (!search.kinds[i])
      return;
    const MeshHandle mesh = meshes[i];
    measures[i] = measureOf(*mesh);
    tolerances[i] = search.tolerance(boxOf(*mesh));
    if (isUnmoved(i))
      coordinateHashes[i] = coordinateHashOf(*mesh);
  });
  std::map<std::array<std::uint64_t, 3>, std::vector<std::size_t>> classes;
  for (const std::size_t i : search.order)
    if (!meshes.partOf(i).positions.empty())
      classes[{*search.kinds[i], measures[i].content, coordinateHashes[i]}].push_back(i);
  std::vector<const std::vector<std::size_t>*> members;
  for (const auto& [key, of] : classes)
    if (of.size() > 1)
      members.push_back(&of);
  std::vector<std::optional<MeshInstance>> instances(meshes.size());
  parallelFor(members.size(), [&](std::size_t i) {
    Class earlier(meshes, measures, tolerances);
    for (const std::size_t mesh : *members[i])
      if (const std::optional<MeshInstance> found = earlier.add(mesh);
          found && (!isUnmoved(mesh) || found->transform == Transform{}))
        instances[mesh] = found;
  });
  return instances;
}

} // namespace imgeo
