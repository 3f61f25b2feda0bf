#include "import/nurbs/surface_vertices.h"

#include <algorithm>

namespace imgeo::nurbs {

namespace {

/// Edges that are closer than this, relative to the size of the surface, coincide; edges shorter than this are poles.
constexpr double samePosition = 1e-7;

} // namespace

SurfaceVertices::SurfaceVertices(const Surface& surface, const std::optional<Surface>& texCoords,
                                 const ParameterGrid& grid, SurfaceMesh& mesh)
    : surface_(surface), texCoords_(texCoords), mesh_(mesh) {
  Box3d box;
  for (const ControlPoint& point : surface.points)
    box.add(point.point);
  maxDistance_ = length(box.size()) * samePosition;
  closesU_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u0(), v, u1(), v); });
  closesV_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u, v0(), u, v1()); });
  isPoleV0_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u0(), v0(), u, v0()); });
  isPoleV1_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u0(), v1(), u, v1()); });
  isPoleU0_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u0(), v0(), u0(), v); });
  isPoleU1_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u1(), v0(), u1(), v); });
}

MeshCorner SurfaceVertices::at(Parameters parameters, Parameters middle) {
  Vertex& vertex = vertices_[parameters];
  if (vertex.normals.empty()) {
    vertex.position = positionAt(canonical(parameters));
    vertex.texCoord = static_cast<std::uint32_t>(mesh_.texCoords.size());
    mesh_.texCoords.push_back(texCoordAt(parameters));
  } else if (!surface_.u.mayHaveCorner(parameters.x) && !surface_.v.mayHaveCorner(parameters.y)) {
    return {vertex.position, vertex.normals.front(), vertex.texCoord};
  }
  return {vertex.position, normalOf(vertex, parameters, middle), vertex.texCoord};
}

Vec3d SurfaceVertices::pointAt(double u, double v) const {
  return evaluate(surface_, surface_.u.spanAt(u), surface_.v.spanAt(v), u, v).point;
}

bool SurfaceVertices::isSame(double u, double v, double otherU, double otherV) const {
  return length(pointAt(u, v) - pointAt(otherU, otherV)) <= maxDistance_;
}

/// One of all parameters that have the same position, for closed edges and poles.
Parameters SurfaceVertices::canonical(Parameters p) const {
  if (closesU_ && p.x == u1())
    p.x = u0();
  if (closesV_ && p.y == v1())
    p.y = v0();
  if ((isPoleV0_ && p.y == v0()) || (isPoleV1_ && p.y == v1()))
    p.x = u0();
  if ((isPoleU0_ && p.x == u0()) || (isPoleU1_ && p.x == u1()))
    p.y = v0();
  return p;
}

std::uint32_t SurfaceVertices::positionAt(Parameters p) {
  const auto [found, isNew] = positions_.try_emplace(p, static_cast<std::uint32_t>(mesh_.positions.size()));
  if (isNew)
    mesh_.positions.push_back(Vec3f(pointAt(p.x, p.y)));
  return found->second;
}

Vec2f SurfaceVertices::texCoordAt(Parameters p) const {
  const double s = (p.x - u0()) / (u1() - u0()), t = (p.y - v0()) / (v1() - v0());
  if (!texCoords_)
    return {static_cast<float>(s), static_cast<float>(t)};
  const auto& [u, v, points] = *texCoords_;
  const double ownU = u.begin() + s * (u.end() - u.begin()), ownV = v.begin() + t * (v.end() - v.begin());
  const Vec3d value = evaluate(*texCoords_, u.spanAt(ownU), v.spanAt(ownV), ownU, ownV).point;
  return {static_cast<float>(value.x), static_cast<float>(value.y)};
}

std::uint32_t SurfaceVertices::normalOf(Vertex& vertex, Parameters p, Parameters middle) {
  const Vec3f normal(normalAt(p, middle));
  for (const std::uint32_t known : vertex.normals)
    if (dot(mesh_.normals[known], normal) > 0.99999f)
      return known;
  vertex.normals.push_back(static_cast<std::uint32_t>(mesh_.normals.size()));
  mesh_.normals.push_back(normal);
  return vertex.normals.back();
}

/// The unit normal. At a pole, where one derivative vanishes, that of a point nearby inside of the cell.
Vec3d SurfaceVertices::normalAt(Parameters p, Parameters middle) const {
  const std::size_t uSpan = surface_.u.spanAt(middle.x), vSpan = surface_.v.spanAt(middle.y);
  for (const double inwards : {0.0, 1e-4, 1e-2, 1.0}) {
    const SurfacePoint point =
        evaluate(surface_, uSpan, vSpan, p.x + (middle.x - p.x) * inwards, p.y + (middle.y - p.y) * inwards);
    const Vec3d normal = point.normal();
    const double size = length(normal);
    if (size > 1e-9 * length(point.alongU) * length(point.alongV) && length(point.alongU) > minDerivative(surface_.u) &&
        length(point.alongV) > minDerivative(surface_.v))
      return normal * (1 / size);
  }
  return {0, 0, 1};
}

} // namespace imgeo::nurbs
