#include "transcode/verify/compare_samples.h"

#include "base/parallel.h"
#include "prepare/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace imgeo {

namespace {

/// The points of a triangle from which a sample may have been taken.
class SourcePoints {
public:
  /// `nearest`: the triangle's point that is nearest to the sample. The sample was taken within `distance` of it, since
  /// projection to a triangle brings no points farther apart.
  SourcePoints(const Mesh& mesh, const Triangle& triangle, const TrianglePoint& nearest, double distance)
      : mesh_(mesh), weights_(nearest.weights) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      wedges_[corner] = mesh.corners[std::size_t{3} * triangle.index + corner];
    const double doubledArea = length(cross(triangle.b - triangle.a, triangle.c - triangle.a));
    const auto changeOf = [&](double oppositeEdge) {
      return distance * oppositeEdge < doubledArea ? distance * oppositeEdge / doubledArea : 1;
    };
    changes_ = {changeOf(length(triangle.c - triangle.a)), changeOf(length(triangle.b - triangle.a))};
  }

  /// How much a value differs from that of all these points.
  template <typename ValueOf> double difference(double value, const ValueOf& valueOf) const {
    const double a = valueOf(wedges_[0]), b = valueOf(wedges_[1]), c = valueOf(wedges_[2]);
    const double rounding =
        2 * std::numeric_limits<float>::epsilon() * std::max({std::abs(a), std::abs(b), std::abs(c)});
    const double change = changes_[0] * std::abs(b - a) + changes_[1] * std::abs(c - a) + rounding;
    return std::max(std::abs(value - (a * weights_.x + b * weights_.y + c * weights_.z)) - change, 0.0);
  }

  /// The same for a normal, in degrees.
  double degrees(const Vec3f& normal) const {
    const Vec3d a(mesh_.normals[wedges_[0]]), b(mesh_.normals[wedges_[1]]), c(mesh_.normals[wedges_[2]]);
    const Vec3d mean = a * weights_.x + b * weights_.y + c * weights_.z;
    const double change = changes_[0] * length(b - a) + changes_[1] * length(c - a), size = length(mean);
    if (change >= size)
      return 0; // any direction
    return std::max(angleDegrees(Vec3d(normal), mean) - std::asin(change / size) * (180 / std::numbers::pi), 0.0);
  }

private:
  const Mesh& mesh_;
  std::array<std::uint32_t, 3> wedges_{};
  Vec3d weights_;
  std::array<double, 2> changes_{}; ///< of the second and the third weight
};

/// A further attribute of the mesh, that of a patch, and the allowed difference of each component.
struct NamedSamples {
  const NamedAttribute& mesh;
  const NamedAttribute& patch;
  const std::vector<double>& bounds;
};

class SampleComparison {
public:
  SampleComparison(const Mesh& mesh, const IndexedPatch& patch, const AttributeBounds& bounds)
      : mesh_(mesh), patch_(patch) {
    for (const NamedAttribute& attribute : mesh.namedAttributes) {
      const auto other = std::ranges::find(patch.namedAttributes, attribute.name, &NamedAttribute::name);
      const auto bound = bounds.named.find(attribute.name);
      if (other != patch.namedAttributes.end() && other->components == attribute.components &&
          bound != bounds.named.end())
        named_.push_back({attribute, *other, bound->second});
    }
  }

  AttributeDifference between(std::size_t vertex, const SourcePoints& points) const {
    AttributeDifference difference;
    if (!mesh_.normals.empty() && !patch_.normals.empty())
      difference.normalDegrees = points.degrees(patch_.normals[vertex]);
    for (std::size_t set = 0; set < std::min(texCoordSetCount(mesh_), texCoordSetCount(patch_)); ++set) {
      const std::vector<Vec2f>& source = texCoordsOf(mesh_, set);
      const Vec2f& stored = texCoordsOf(patch_, set)[vertex];
      difference.texCoords[set] = {points.difference(stored.x, [&](std::uint32_t w) { return double{source[w].x}; }),
                                   points.difference(stored.y, [&](std::uint32_t w) { return double{source[w].y}; })};
    }
    if (!mesh_.colors.empty() && !patch_.colors.empty())
      for (float Rgba::*channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a})
        difference.color =
            std::max(difference.color, points.difference(patch_.colors[vertex].*channel, [&](std::uint32_t w) {
              return double{mesh_.colors[w].*channel};
            }));
    for (const NamedSamples& pair : named_)
      for (std::size_t c = 0; c < pair.mesh.components; ++c) {
        const auto valueOf = [&](std::uint32_t w) {
          return double{pair.mesh.values[std::size_t{w} * pair.mesh.components + c]};
        };
        const double off = points.difference(pair.patch.values[vertex * pair.mesh.components + c], valueOf);
        difference.named = std::max(difference.named, off / divisor(pair.bounds[c]));
      }
    return difference;
  }

private:
  const Mesh& mesh_;
  const IndexedPatch& patch_;
  std::vector<NamedSamples> named_;
};

} // namespace

SampleDifference compareSamples(const Mesh& mesh, const std::vector<IndexedPatch>& patches, const Lattice& lattice,
                                double distance, const AttributeBounds& bounds) {
  const TriangleTree tree(meshTriangles(mesh));
  std::vector<SampleDifference> ofPatches(patches.size());
  parallelFor(patches.size(), [&](std::size_t i) {
    const IndexedPatch& patch = patches[i];
    const SampleComparison comparison(mesh, patch, bounds);
    SampleDifference& worst = ofPatches[i];
    worst.samples = patch.positions.size();
    for (std::size_t vertex = 0; vertex < patch.positions.size(); ++vertex) {
      std::optional<AttributeDifference> best;
      tree.visitWithin(lattice.point(patch.positions[vertex]), distance,
                       [&](const Triangle& triangle, const TrianglePoint& nearest) {
                         const AttributeDifference difference =
                             comparison.between(vertex, SourcePoints(mesh, triangle, nearest, distance));
                         if (!best || cost(difference, bounds) < cost(*best, bounds))
                           best = difference;
                       });
      worst.beside += !best;
      worst.colorsDiffering += best && best->color > bounds.color;
      if (best)
        addToWorst(*best, worst);
    }
  });
  SampleDifference worst;
  for (const SampleDifference& difference : ofPatches) {
    addToWorst(difference, worst);
    worst.samples += difference.samples;
    worst.beside += difference.beside;
    worst.colorsDiffering += difference.colorsDiffering;
  }
  return worst;
}

} // namespace imgeo
