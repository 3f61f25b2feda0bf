#pragma once
// Whether a mesh that is moved by a rigid map is another mesh: the same elements and attributes, in any order.

#include "base/affine.h"
#include "scene/mesh.h"

#include <optional>
#include <vector>

namespace imgeo {

/// How far apart what corresponds may be.
struct CongruenceTolerance {
  double distance = 0;        ///< of positions, in units of the source
  double normal = 2.0 / 1024; ///< length of the difference of unit normals: a ninth of a degree
};

struct Correspondence {
  std::vector<std::uint32_t> positions; ///< position of the first mesh -> position of the second
  double distance = 0;                  ///< the largest one of positions that correspond
  double normal = 0;                    ///< the largest length of a difference of normals
};

/// Whether the meshes have as many positions, wedges and elements of the same topology, and the same attributes; of
/// named ones the same names.
bool haveSameCounts(const Mesh& a, const Mesh& b);

/// Pairs every position of `from`, moved by `map`, with one of `to` within the tolerance, each once, and every element
/// with one that has the same corners in the same cyclic order (lines and points: in the same order), normals within
/// the tolerance and other attributes that are equal. Nothing where that is not possible. Of positions of `to` the
/// nearest is taken, unless both meshes have the same order.
std::optional<Correspondence> correspondence(const Mesh& from, const Mesh& to, const Affine3d& map,
                                             const CongruenceTolerance& tolerance);

} // namespace imgeo
