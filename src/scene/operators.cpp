#include "scene/operators.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace imgeo {

namespace {

double mapped(const Operator& op, double c, int axis) {
  const double a = op.a[axis], b = op.b[axis];
  switch (op.kind) {
  case OperatorKind::affine:
    return a * c + b;
  case OperatorKind::power:
    return std::pow(std::max(c, 0.0), a);
  case OperatorKind::fold:
    return c > a ? 2 * a - c : c;
  case OperatorKind::clamp:
    return std::min(std::max(c, a), b);
  case OperatorKind::steps:
    return std::floor(c * a + 0.5) / a;
  case OperatorKind::permute:
  case OperatorKind::blur:
    break;
  }
  return c;
}

/// The axis whose coordinate an operator maps to `axis`.
int sourceOf(const Operator& op, int axis) {
  return op.kind == OperatorKind::permute ? static_cast<int>(op.a[axis]) : axis;
}

Vec3d mapped(const Operator& op, Vec3d c) {
  Vec3d result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = mapped(op, c[sourceOf(op, axis)], axis);
  return result;
}

/// The derivative of a coordinate, as the vertex shader has it.
double slopeOf(const Operator& op, double c, int axis) {
  const double a = op.a[axis];
  switch (op.kind) {
  case OperatorKind::affine:
    return a;
  case OperatorKind::power:
    return a * std::pow(std::max(c, 1e-4), a - 1);
  case OperatorKind::fold:
    return c > a ? -1 : 1;
  case OperatorKind::clamp:
    return c == mapped(op, c, axis) ? 1 : 0;
  case OperatorKind::steps:
  case OperatorKind::permute:
  case OperatorKind::blur:
    break;
  }
  return 1;
}

/// Whether a permutation of the axes exchanges two, so that it mirrors.
bool isOdd(const Vec3d& axes) {
  return (axes.y - axes.x) * (axes.z - axes.x) * (axes.z - axes.y) < 0;
}

/// The same direction, scaled by a power of two so that the largest coordinate is between 1 and 2: products of many
/// slopes would leave the range in which the squares of a length are exact. Zero and what is not finite stay.
Vec3d inRange(const Vec3d& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest))
    return v;
  const int exponent = -std::ilogb(largest);
  return {std::scalbn(v.x, exponent), std::scalbn(v.y, exponent), std::scalbn(v.z, exponent)};
}

/// The normal of a mapped surface at a point of the unit box, on the side that the winding of its triangles has.
Vec3d operatedNormal(std::span<const Operator> operators, Vec3d c, Vec3d normal) {
  for (const Operator& op : operators) {
    if (op.kind == OperatorKind::permute) {
      normal = mapped(op, normal) * (isOdd(op.a) ? -1 : 1);
    } else {
      const Vec3d slope{slopeOf(op, c.x, 0), slopeOf(op, c.y, 1), slopeOf(op, c.z, 2)};
      // The cofactors of the slopes; where they flatten the surface to a line, the normal stays.
      const Vec3d turned{normal.x * slope.y * slope.z, normal.y * slope.z * slope.x, normal.z * slope.x * slope.y};
      if (turned != Vec3d{})
        normal = inRange(turned);
    }
    c = mapped(op, c);
  }
  return normal;
}

} // namespace

const char* nameOf(OperatorKind kind) {
  constexpr const char* names[] = {"affine", "power", "fold", "clamp", "steps", "permute", "blur"};
  return names[static_cast<std::size_t>(kind)];
}

const char* nameOf(Orientation orientation) {
  constexpr const char* names[] = {"kept", "flipped", "folded"};
  return names[static_cast<std::size_t>(orientation)];
}

double blurRadiusOf(std::span<const Operator> operators) {
  return !operators.empty() && operators[0].kind == OperatorKind::blur ? operators[0].a.x : 0;
}

Orientation orientationOf(std::span<const Operator> operators) {
  bool isFlipped = false;
  for (const Operator& op : operators) {
    if (op.kind == OperatorKind::fold)
      return Orientation::folded;
    isFlipped ^= op.kind == OperatorKind::permute ? isOdd(op.a)
                                                  : op.kind == OperatorKind::affine && op.a.x * op.a.y * op.a.z < 0;
  }
  return isFlipped ? Orientation::flipped : Orientation::kept;
}

Vec3d operatedPoint(std::span<const Operator> operators, Vec3d point) {
  for (const Operator& op : operators)
    point = mapped(op, point);
  return point;
}

Box3d operatedBox(std::span<const Operator> operators, const Box3d& box) {
  Box3d result = box;
  for (const Operator& op : operators) {
    const Box3d before = result;
    for (int axis = 0; axis < 3; ++axis) {
      const int from = sourceOf(op, axis);
      const double low = mapped(op, before.min[from], axis), high = mapped(op, before.max[from], axis);
      result.min[axis] = std::min(low, high);
      result.max[axis] = std::max(low, high);
      // The image of an interval ends in images of its ends and of the only turning point.
      if (op.kind == OperatorKind::fold && before.min[from] < op.a[axis] && before.max[from] > op.a[axis])
        result.max[axis] = op.a[axis];
    }
  }
  return result;
}

OperatorFrame OperatorFrame::of(const Box3d& box) {
  const double longest = box.longestEdge() > 0 ? box.longestEdge() : 1;
  OperatorFrame frame{box.empty() ? Vec3d{} : box.min, box.size()};
  for (int axis = 0; axis < 3; ++axis)
    if (!(frame.size[axis] > 0))
      frame.size[axis] = longest;
  return frame;
}

Vec3d OperatorFrame::toUnit(Vec3d point) const {
  return {(point.x - min.x) / size.x, (point.y - min.y) / size.y, (point.z - min.z) / size.z};
}

Vec3d OperatorFrame::fromUnit(Vec3d point) const {
  return {min.x + point.x * size.x, min.y + point.y * size.y, min.z + point.z * size.z};
}

void applyOperators(Mesh& mesh, std::span<const Operator> operators, const OperatorFrame& frame,
                    const std::string& location) {
  if (operators.empty())
    return;
  const bool isFlipped = orientationOf(operators) == Orientation::flipped && mesh.topology == Topology::triangles;
  for (std::size_t wedge = 0; wedge < mesh.normals.size(); ++wedge) {
    const Vec3d normal(mesh.normals[wedge]), extent = frame.size;
    const Vec3d inUnit{normal.x * extent.x, normal.y * extent.y, normal.z * extent.z};
    const Vec3d point = frame.toUnit(Vec3d(mesh.positions[mesh.wedgePositions[wedge]]));
    const Vec3d turned = operatedNormal(operators, point, inUnit) * (isFlipped ? -1 : 1);
    const Vec3d direction{turned.x / extent.x, turned.y / extent.y, turned.z / extent.z};
    if (const double size = length(direction); size > 0 && std::isfinite(size))
      mesh.normals[wedge] = Vec3f(direction * (1 / size));
  }
  for (Vec3f& position : mesh.positions) {
    position = Vec3f(frame.fromUnit(operatedPoint(operators, frame.toUnit(Vec3d(position)))));
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
      throw Error(ErrorKind::limit, location, "operators move a vertex farther than floats reach");
  }
  for (std::size_t corner = 0; isFlipped && corner + 2 < mesh.corners.size(); corner += 3)
    std::swap(mesh.corners[corner + 1], mesh.corners[corner + 2]);
}

} // namespace imgeo
