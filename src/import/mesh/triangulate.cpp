// Ear clipping after Meisters, "Polygons have ears" (1975): an ear is a convex corner whose triangle holds no other
// corner. Only reflex corners can lie in such a triangle (Eberly, "Triangulation by ear clipping", 2002).
#include "import/mesh/triangulate.h"

#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

using Vec2d = Vec2<double>;

/// Twice the signed area of a triangle; positive if it is counter-clockwise.
double twiceArea(Vec2d a, Vec2d b, Vec2d c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

Vec3d newellNormal(std::span<const Vec3f> ring) {
  Vec3d normal;
  const Vec3d origin(ring[0]);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    normal += cross(Vec3d(ring[i]) - origin, Vec3d(ring[i + 1]) - origin);
  return normal;
}

/// The ring projected along the coordinate axis nearest to its normal, counter-clockwise.
std::vector<Vec2d> project(std::span<const Vec3f> ring, Vec3d normal) {
  int axis = 0;
  for (int other : {1, 2})
    if (std::abs(normal[other]) > std::abs(normal[axis]))
      axis = other;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0)
    std::swap(u, v);
  std::vector<Vec2d> flat;
  flat.reserve(ring.size());
  for (const Vec3f& p : ring)
    flat.push_back({p[u], p[v]});
  return flat;
}

bool isConvex(std::span<const Vec2d> flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i)
    if (twiceArea(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0)
      return false;
  // All corners of a star polygon are convex too; its fan has negative areas.
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (twiceArea(flat[0], flat[i], flat[i + 1]) < 0)
      return false;
  return true;
}

/// Whether p lies in a counter-clockwise triangle or on its border.
bool inside(Vec2d p, Vec2d a, Vec2d b, Vec2d c) {
  return twiceArea(a, b, p) >= 0 && twiceArea(b, c, p) >= 0 && twiceArea(c, a, p) >= 0;
}

class EarClipper {
public:
  explicit EarClipper(std::span<const Vec2d> flat) : flat_(flat) {
    for (std::size_t i = 0; i < flat.size(); ++i)
      remaining_.push_back(static_cast<std::uint32_t>(i));
  }

  void clipInto(std::vector<std::uint32_t>& triangles) {
    std::size_t at = 0, tried = 0;
    while (remaining_.size() > 2) {
      const std::size_t n = remaining_.size();
      // A simple polygon always has an ear. A polygon that intersects itself may have none: then any corner is
      // clipped, so that the number of triangles is always the number of corners - 2.
      if (tried < n && !isEar(at)) {
        at = (at + 1) % n;
        ++tried;
        continue;
      }
      triangles.insert(triangles.end(), {corner(at + n - 1), corner(at), corner(at + 1)});
      remaining_.erase(remaining_.begin() + static_cast<std::ptrdiff_t>(at));
      // Skips a corner: clipping neighbouring ears in turn would make thin triangles.
      at = (at + 1) % remaining_.size();
      tried = 0;
    }
  }

private:
  std::uint32_t corner(std::size_t at) const { return remaining_[at % remaining_.size()]; }
  double turn(std::size_t at) const {
    return twiceArea(flat_[corner(at + remaining_.size() - 1)], flat_[corner(at)], flat_[corner(at + 1)]);
  }
  bool isEar(std::size_t at) const {
    const std::size_t n = remaining_.size();
    if (turn(at) <= 0)
      return false;
    const Vec2d a = flat_[corner(at + n - 1)], b = flat_[corner(at)], c = flat_[corner(at + 1)];
    for (std::size_t other = at + 2; other < at + n - 1; ++other) {
      const Vec2d p = flat_[corner(other)];
      // A ring with a bridge to a hole visits both ends of the bridge twice.
      if (p == a || p == b || p == c || turn(other) > 0)
        continue;
      if (inside(p, a, b, c))
        return false;
    }
    return true;
  }

  std::span<const Vec2d> flat_;
  std::vector<std::uint32_t> remaining_; ///< corners that are not clipped yet, in ring order
};

} // namespace

bool triangulate(std::span<const Vec3f> ring, std::vector<std::uint32_t>& triangles) {
  assert(ring.size() >= 3);
  const Vec3d normal = newellNormal(ring);
  const bool isTrivial = ring.size() == 3 || dot(normal, normal) == 0;
  const std::vector<Vec2d> flat = isTrivial ? std::vector<Vec2d>{} : project(ring, normal);
  const bool isFanCorrect = isTrivial || isConvex(flat);
  if (isFanCorrect || ring.size() > maxEarClippedCorners) {
    for (std::uint32_t i = 1; i + 1 < ring.size(); ++i)
      triangles.insert(triangles.end(), {0, i, i + 1});
    return isFanCorrect;
  }
  EarClipper(flat).clipInto(triangles);
  return true;
}

} // namespace imgeo
