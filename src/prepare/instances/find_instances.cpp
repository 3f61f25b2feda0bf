#include "prepare/instances/find_instances.h"

#include "base/parallel.h"
#include "prepare/index_hash_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>

namespace imgeo {

namespace {

constexpr std::size_t maxComparisons = 32;

/// What single precision may have rounded two meshes by whose largest coordinates have this sum.
double roundingOf(double coordinates) {
  return std::ldexp(coordinates, -23);
}

/// A hash of the coordinates in their order.
std::uint64_t coordinateHashOf(const Mesh& mesh) {
  std::uint64_t hash = 1;
  for (const Vec3f& position : mesh.positions)
    for (int axis = 0; axis < 3; ++axis)
      hash = mixHash(hash, std::bit_cast<std::uint32_t>(position[axis]));
  return hash;
}

/// What is known of each mesh before meshes are compared.
struct Measured {
  std::vector<MeshMeasure> measures;
  std::vector<double> tolerances;
  double largestCoordinate = 0; ///< of all
};

/// The meshes of one kind with the same content, by their sizes.
class Class {
public:
  Class(const SceneMeshes& meshes, const Measured& measured) : meshes_(meshes), measured_(measured) {}

  /// An instance of an earlier mesh; otherwise the mesh is one of them from now on.
  std::optional<MeshInstance> add(std::size_t mesh) {
    const MeshMeasure& measure = measured_.measures[mesh];
    const double own = measured_.tolerances[mesh];
    std::vector<std::size_t> candidates;
    const double rounding = roundingOf(measure.largestCoordinate + measured_.largestCoordinate),
                 reach = 2 * (own + std::min(rounding, measure.radius / 1024)); // see congruenceDistance
    const auto last = earlier_.upper_bound(measure.gyration + reach);
    for (auto each = earlier_.lower_bound(measure.gyration - reach); each != last; ++each) {
      const MeshMeasure& other = measured_.measures[each->second];
      const double distance = congruenceDistance(std::min(own, measured_.tolerances[each->second]), other, measure);
      if (mayBeCongruent(other, measure, distance))
        candidates.push_back(each->second);
    }
    std::ranges::sort(candidates, {}, [&](std::size_t candidate) { return numbers_.at(candidate); });
    candidates.resize(std::min(candidates.size(), maxComparisons));
    if (!candidates.empty()) {
      const MeshHandle handle = meshes_[mesh];
      for (const std::size_t candidate : candidates) {
        const MeshMeasure& other = measured_.measures[candidate];
        const CongruenceTolerance tolerance{
            congruenceDistance(std::min(own, measured_.tolerances[candidate]), other, measure)};
        const MeshHandle earlier = meshes_[candidate];
        if (const auto transform = findRigidMap(*earlier, other, *handle, measure, tolerance))
          return MeshInstance{candidate, *transform,
                              correspondence(*earlier, *handle, affineOf(*transform), tolerance).value().distance};
      }
    }
    numbers_.emplace(mesh, numbers_.size());
    earlier_.emplace(measure.gyration, mesh);
    return std::nullopt;
  }

private:
  const SceneMeshes& meshes_;
  const Measured& measured_;
  std::multimap<double, std::size_t> earlier_;           ///< meshes that stand for themselves, by gyration
  std::unordered_map<std::size_t, std::size_t> numbers_; ///< the order in which they came
};

using Instances = std::vector<std::optional<MeshInstance>>;

/// Compares meshes of one class each: equal `keyOf`. Meshes without a key are not compared.
template <typename KeyOf>
void compareClasses(const SceneMeshes& meshes, const std::vector<std::size_t>& order, const Measured& measured,
                    const KeyOf& keyOf, Instances& instances) {
  using Key = std::array<std::uint64_t, 3>;
  std::map<Key, std::vector<std::size_t>> classes;
  for (const std::size_t mesh : order)
    if (const std::optional<Key> key = keyOf(mesh))
      classes[*key].push_back(mesh);
  std::vector<const std::vector<std::size_t>*> members;
  for (const auto& [key, of] : classes)
    if (of.size() > 1)
      members.push_back(&of);
  parallelFor(members.size(), [&](std::size_t i) {
    Class earlier(meshes, measured);
    for (const std::size_t mesh : *members[i])
      instances[mesh] = earlier.add(mesh);
  });
}

/// Small meshes of which too few are equal, for each of which a Transform is too much. They have no instance any more.
std::vector<bool> takeSmallClasses(const InstanceSearch& search, Instances& instances) {
  std::vector<bool> isTaken(instances.size());
  if (search.small.empty())
    return isTaken;
  std::vector<std::size_t> sizes(instances.size());
  for (const std::size_t mesh : search.order)
    ++sizes[instances[mesh] ? instances[mesh]->mesh : mesh];
  for (const std::size_t mesh : search.order)
    isTaken[mesh] = search.small[mesh] && sizes[instances[mesh] ? instances[mesh]->mesh : mesh] < search.minSmallClass;
  for (std::size_t mesh = 0; mesh < instances.size(); ++mesh)
    if (isTaken[mesh])
      instances[mesh].reset();
  return isTaken;
}

} // namespace

double congruenceDistance(double tolerance, const MeshMeasure& a, const MeshMeasure& b) {
  const double rounding = roundingOf(a.largestCoordinate + b.largestCoordinate);
  return tolerance + std::min(rounding, std::min(a.radius, b.radius) / 1024);
}

std::vector<std::optional<MeshInstance>> findInstances(const SceneMeshes& meshes, const InstanceSearch& search) {
  Measured measured{std::vector<MeshMeasure>(meshes.size()), std::vector<double>(meshes.size())};
  std::vector<std::uint64_t> coordinateHashes(search.small.size());
  parallelFor(meshes.size(), [&](std::size_t i) {
    if (!search.kinds[i])
      return;
    const MeshHandle mesh = meshes[i];
    measured.measures[i] = measureOf(*mesh);
    measured.tolerances[i] = search.tolerance(boxOf(*mesh));
    if (!search.small.empty() && search.small[i])
      coordinateHashes[i] = coordinateHashOf(*mesh);
  });
  for (const MeshMeasure& measure : measured.measures)
    measured.largestCoordinate = std::max(measured.largestCoordinate, measure.largestCoordinate);
  using Key = std::optional<std::array<std::uint64_t, 3>>;
  Instances instances(meshes.size());
  compareClasses(
      meshes, search.order, measured,
      [&](std::size_t i) {
        return meshes.partOf(i).positions.empty() ? Key() : Key({*search.kinds[i], measured.measures[i].content, 0});
      },
      instances);
  const std::vector<bool> isRare = takeSmallClasses(search, instances);
  Instances unmoved(meshes.size());
  compareClasses(
      meshes, search.order, measured,
      [&](std::size_t i) {
        return !isRare[i] || meshes.partOf(i).positions.empty()
                   ? Key()
                   : Key({*search.kinds[i], measured.measures[i].content, coordinateHashes[i]});
      },
      unmoved);
  for (std::size_t i = 0; i < instances.size(); ++i)
    if (unmoved[i] && unmoved[i]->transform == Transform{})
      instances[i] = unmoved[i];
  return instances;
}

} // namespace imgeo
