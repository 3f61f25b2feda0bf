#pragma once
// Finds the rigid map, a rotation and a translation, that makes one mesh of another: docs/decisions/instances.md.

#include "prepare/instances/correspondence.h"
#include "scene/transform.h"

namespace imgeo {

/// What rigid maps leave as it is, but for rounding, and where the mesh is.
struct MeshMeasure {
  Vec3d centroid;               ///< mean of the positions
  double gyration = 0;          ///< root of the mean of the squared distances from the centroid
  double radius = 0;            ///< largest distance from it
  double largestCoordinate = 0; ///< without its sign
  std::uint64_t content = 0;    ///< a hash of the counts and of the values of all attributes but normals, in any order
};

MeshMeasure measureOf(const Mesh& mesh);

/// Whether a rigid map may exist within this distance.
bool mayBeCongruent(const MeshMeasure& a, const MeshMeasure& b, double distance);

/// A Transform with few decimal digits and no scale that maps `from` to `to` as correspondence() asks for, or nothing
/// if none was found. A translation alone is preferred. Meshes with the same order of vertices and elements are
/// compared as they are; otherwise two vertices, seen from the centroid, of the most remarkable distances from it are
/// mapped to every pair at these distances, up to a limit. Meshes whose named attributes have three components or more,
/// which may be directions, are only translated.
std::optional<Transform> findRigidMap(const Mesh& from, const MeshMeasure& fromMeasure, const Mesh& to,
                                      const MeshMeasure& toMeasure, const CongruenceTolerance& tolerance);

} // namespace imgeo
