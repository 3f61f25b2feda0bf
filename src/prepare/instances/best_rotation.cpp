#include "prepare/instances/best_rotation.h"

#include "scene/transform.h"

#include <array>
#include <cmath>

namespace imgeo {

namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// The eigenvector of the largest eigenvalue of a symmetric matrix, by Jacobi's method.
std::array<double, 4> largestEigenvector(Matrix4 m) {
  Matrix4 axes{}; // the columns are eigenvectors
  for (std::size_t i = 0; i < 4; ++i)
    axes[i][i] = 1;
  for (int sweep = 0; sweep < 32; ++sweep)
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (m[p][q] == 0)
          continue;
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        const auto turn = [&](double& first, double& second) {
          const double before = first;
          first = c * before - s * second;
          second = s * before + c * second;
        };
        for (std::size_t i = 0; i < 4; ++i)
          turn(m[i][p], m[i][q]);
        for (std::size_t i = 0; i < 4; ++i)
          turn(m[p][i], m[q][i]);
        for (std::size_t i = 0; i < 4; ++i)
          turn(axes[i][p], axes[i][q]);
        m[p][q] = m[q][p] = 0;
      }
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (m[i][i] > m[largest][largest])
      largest = i;
  return {axes[0][largest], axes[1][largest], axes[2][largest], axes[3][largest]};
}

} // namespace

Affine3d bestRotation(const PairSums& pairs) {
  // Horn's S_xy is the sum of a.x b.y.
  const Affine3d& s = pairs.sums;
  const double xx = s.x.x, xy = s.x.y, xz = s.x.z, yx = s.y.x, yy = s.y.y, yz = s.y.z, zx = s.z.x, zy = s.z.y,
               zz = s.z.z;
  const Matrix4 matrix{{{xx + yy + zz, yz - zy, zx - xz, xy - yx},
                        {yz - zy, xx - yy - zz, xy + yx, zx + xz},
                        {zx - xz, xy + yx, yy - xx - zz, yz + zy},
                        {xy - yx, zx + xz, yz + zy, zz - xx - yy}}};
  const auto [w, x, y, z] = largestEigenvector(matrix);
  return affineOf(rotationOfQuaternion(x, y, z, w));
}

} // namespace imgeo
