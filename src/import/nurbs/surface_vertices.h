#pragma once
// Makes the vertices of a NURBS surface.

#include "import/nurbs/parameter_grid.h"
#include "import/nurbs/tessellate_surface.h"
#include "import/nurbs/trim.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace imgeo::nurbs {

/// Vertices with equal positions, as those of closed edges and poles, share one.
class SurfaceVertices {
public:
  /// Vertices are added to `mesh`. All must outlive this, but the grid. `texCoords`: see tessellate.
  SurfaceVertices(const Surface& surface, const std::optional<Surface>& texCoords, const ParameterGrid& grid,
                  SurfaceMesh& mesh);

  /// The corner at these parameters, with the normal of the knot interval that contains the cell's middle.
  MeshCorner at(Parameters parameters, Parameters middle);

  Vec3d position(const MeshCorner& corner) const { return Vec3d(mesh_.positions[corner.position]); }

private:
  struct Vertex {
    std::uint32_t position = 0, texCoord = 0;
    std::vector<std::uint32_t> normals; ///< several at a crease
  };

  struct ParametersHash {
    std::size_t operator()(const Parameters& p) const {
      return std::hash<double>()(p.x) * 0x9e3779b97f4a7c15 ^ std::hash<double>()(p.y);
    }
  };

  double u0() const { return surface_.u.begin(); }
  double u1() const { return surface_.u.end(); }
  double v0() const { return surface_.v.begin(); }
  double v1() const { return surface_.v.end(); }

  Vec3d pointAt(double u, double v) const;
  bool isSame(double u, double v, double otherU, double otherV) const;
  Parameters canonical(Parameters p) const;
  std::uint32_t positionAt(Parameters p);
  Vec2f texCoordAt(Parameters p) const;
  std::uint32_t normalOf(Vertex& vertex, Parameters p, Parameters middle);
  Vec3d normalAt(Parameters p, Parameters middle) const;

  /// A derivative shorter than this counts as zero.
  double minDerivative(const Basis& basis) const { return maxDistance_ / (basis.end() - basis.begin()); }

  const Surface& surface_;
  const std::optional<Surface>& texCoords_;
  SurfaceMesh& mesh_;
  double maxDistance_ = 0;
  bool closesU_ = false, closesV_ = false, isPoleU0_ = false, isPoleU1_ = false, isPoleV0_ = false, isPoleV1_ = false;
  std::unordered_map<Parameters, Vertex, ParametersHash> vertices_;
  std::unordered_map<Parameters, std::uint32_t, ParametersHash> positions_;
};

} // namespace imgeo::nurbs
