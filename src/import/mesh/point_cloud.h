#pragma once
// What the readers of point clouds share: positions around an origin, colours, and named values of each point.

#include "base/vec.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// What is subtracted from double coordinates before they become single ones: whole units near the middle of the box
/// on each axis on which it is more than 16 times farther from zero than its longest edge, where single precision, 24
/// bits, would leave less than 20 bits for the cloud; 0 on the others.
Vec3d originOf(const Box3d& box);

/// A mesh of points without attributes.
Mesh pointCloud(std::string name, std::vector<Vec3f> positions);

/// Points before the origin of their file is known. The other lists are empty or as long as the positions.
struct CloudPoints {
  std::vector<Vec3d> positions;
  std::vector<Vec3f> normals; ///< of unit length
  std::vector<Rgba> colors;
  std::vector<NamedAttribute> values;
};

/// A mesh of points around an origin.
Mesh pointCloud(std::string name, CloudPoints points, const Vec3d& origin);

/// The colour of three channels of 0 ... `white`. Others are clamped; `clamped` counts those beyond rounding.
Rgba pointColor(std::span<const double, 3> channels, double white, std::uint64_t& clamped);

/// States at each root of a scene what has been subtracted from its coordinates, if anything.
void addOrigin(SceneGraph& graph, const Vec3d& origin);

/// A name of a point's values that can stand in documents and lists, and that is not among those taken.
std::string pointValueName(std::string_view stored, std::span<const std::string> taken);

/// Adds values to a mesh. 0 replaces those that are infinite or NaN, with a warning.
void addPointValues(Mesh& mesh, NamedAttribute values, std::vector<std::string>& warnings);

} // namespace imgeo
