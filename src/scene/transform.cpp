#include "scene/transform.h"

#include <cmath>
#include <utility>

namespace imgeo {

namespace {

Affine3d transposed(const Affine3d& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}, {}};
}

Affine3d scaled(Vec3d scale) {
  return {{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, {}};
}

/// The rotation of a rotation matrix, computed from the largest component of its quaternion (Shepperd 1978).
Rotation rotationOf(const Affine3d& m) {
  const double w = m.x.x + m.y.y + m.z.z, x = m.x.x - m.y.y - m.z.z, y = m.y.y - m.x.x - m.z.z,
               z = m.z.z - m.x.x - m.y.y;
  if (w >= x && w >= y && w >= z)
    return rotationOfQuaternion(m.y.z - m.z.y, m.z.x - m.x.z, m.x.y - m.y.x, 1 + w);
  if (x >= y && x >= z)
    return rotationOfQuaternion(1 + x, m.x.y + m.y.x, m.z.x + m.x.z, m.y.z - m.z.y);
  if (y >= z)
    return rotationOfQuaternion(m.x.y + m.y.x, 1 + y, m.y.z + m.z.y, m.z.x - m.x.z);
  return rotationOfQuaternion(m.z.x + m.x.z, m.y.z + m.z.y, 1 + z, m.x.y - m.y.x);
}

struct Eigen {
  Affine3d axes; ///< orthonormal, right-handed
  Vec3d values;
};

/// Eigenvectors and eigenvalues of a symmetric matrix by Jacobi's method: rotates pairs of axes until all off-diagonal
/// elements are zero.
Eigen eigenOf(Affine3d m) {
  Affine3d axes;
  const auto column = [](Affine3d& matrix, int i) -> Vec3d& {
    return i == 0 ? matrix.x : i == 1 ? matrix.y : matrix.z;
  };
  for (int sweep = 0; sweep < 32; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      const double offDiagonal = column(m, p)[q];
      if (offDiagonal == 0)
        continue;
      const double theta = (column(m, q)[q] - column(m, p)[p]) / (2 * offDiagonal);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      Affine3d pairRotation;
      column(pairRotation, p)[p] = column(pairRotation, q)[q] = c;
      column(pairRotation, p)[q] = -s;
      column(pairRotation, q)[p] = s;
      m = transposed(pairRotation) * m * pairRotation;
      column(m, p)[q] = column(m, q)[p] = 0;
      axes = axes * pairRotation;
    }
  return {axes, {m.x.x, m.y.y, m.z.z}};
}

Vec3d lengthsOf(const Affine3d& m) {
  return {length(m.x), length(m.y), length(m.z)};
}

/// Whether the columns are orthogonal, apart from rounding errors.
bool isOrthogonal(const Affine3d& m, Vec3d lengths) {
  constexpr double tolerance = 1e-12;
  return std::abs(dot(m.x, m.y)) <= tolerance * lengths.x * lengths.y &&
         std::abs(dot(m.x, m.z)) <= tolerance * lengths.x * lengths.z &&
         std::abs(dot(m.y, m.z)) <= tolerance * lengths.y * lengths.z;
}

/// Normalises orthogonal columns and stores their lengths in `scale`. A column of zero length gets a direction that
/// completes the frame.
Affine3d frameOf(const Affine3d& columns, Vec3d& scale) {
  Vec3d to[3] = {columns.x, columns.y, columns.z};
  scale = lengthsOf(columns);
  const double longest = std::max({scale.x, scale.y, scale.z});
  if (!(longest > 0))
    return {};
  int knownAxis = 0; // index of a column of nonzero length
  for (int axis = 0; axis < 3; ++axis) {
    if (scale[axis] <= 1e-9 * longest) {
      scale[axis] = 0;
      continue;
    }
    to[axis] = to[axis] * (1 / scale[axis]);
    knownAxis = axis;
  }
  const int next = (knownAxis + 1) % 3, last = (knownAxis + 2) % 3;
  if (scale[next] == 0 && scale[last] == 0) {
    const Vec3d across = cross(to[knownAxis], std::abs(to[knownAxis].x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
    to[next] = across * (1 / length(across));
  } else if (scale[next] == 0) {
    to[next] = cross(to[last], to[knownAxis]);
  }
  if (scale[last] == 0)
    to[last] = cross(to[knownAxis], to[next]);
  return {to[0], to[1], to[2], {}};
}

/// M = R P with P = sqrt(M^T M); the eigenvectors and eigenvalues of P are the axes and factors of the stretch.
Transform polarDecomposition(const Affine3d& linear) {
  const Eigen stretch = eigenOf(transposed(linear) * linear);
  Transform transform;
  transform.scaleOrientation = rotationOf(stretch.axes);
  const Affine3d turned = frameOf(linear * stretch.axes, transform.scale);
  transform.rotation = rotationOf(turned * transposed(stretch.axes));
  return transform;
}

} // namespace

Rotation rotationOfQuaternion(double x, double y, double z, double w) {
  const double imaginaryLength = length(Vec3d{x, y, z});
  if (!(imaginaryLength > 0))
    return {};
  const double sign = w < 0 ? -1 : 1; // the rotation by at most pi
  return {Vec3d{x, y, z} * (sign / imaginaryLength), 2 * std::atan2(imaginaryLength, std::abs(w))};
}

std::array<double, 4> quaternionOf(const Rotation& rotation) {
  const double size = length(rotation.axis), sine = size > 0 ? std::sin(rotation.angle / 2) / size : 0;
  return {rotation.axis.x * sine, rotation.axis.y * sine, rotation.axis.z * sine,
          size > 0 ? std::cos(rotation.angle / 2) : 1};
}

Affine3d affineOf(const Rotation& rotation) {
  const double axisLength = length(rotation.axis);
  if (rotation.angle == 0 || !(axisLength > 0))
    return {};
  // Rodrigues' formula, applied to the axes.
  const Vec3d k = rotation.axis * (1 / axisLength);
  const double c = std::cos(rotation.angle), s = std::sin(rotation.angle);
  const auto turned = [&](Vec3d v) { return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c)); };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

Affine3d affineOf(const Transform& transform) {
  const Affine3d axes = affineOf(transform.scaleOrientation);
  Affine3d map = affineOf(transform.rotation) * axes * scaled(transform.scale) * transposed(axes);
  map.translation = transform.translation + transform.center - map.direction(transform.center);
  return map;
}

Transform transformOf(const Affine3d& map) {
  Affine3d linear{map.x, map.y, map.z, {}};
  // A reflection is a rotation and a stretch by negative factors.
  const double sign = linear.determinant() < 0 ? -1 : 1;
  if (sign < 0)
    linear = {linear.x * -1, linear.y * -1, linear.z * -1, {}};
  const Vec3d lengths = lengthsOf(linear);
  Transform transform;
  if (isOrthogonal(linear, lengths)) // the common case: a scale along the axes needs no scaleOrientation
    transform.rotation = rotationOf(frameOf(linear, transform.scale));
  else
    transform = polarDecomposition(linear);
  transform.scale = transform.scale * sign;
  transform.translation = map.translation;
  return transform;
}

} // namespace imgeo
