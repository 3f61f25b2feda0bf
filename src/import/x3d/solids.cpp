#include "import/x3d/solids.h"

#include "import/x3d/round_segments.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace imgeo::x3d {

namespace {

struct SolidCorner {
  Vec3d position, normal;
  Vec2<double> texCoord;
};

/// Adds a face whose corners have vertices of their own; they run counter-clockwise as seen from outside.
void addFace(std::span<const SolidCorner> corners, VertexData& data, Faces& faces) {
  for (const SolidCorner& corner : corners) {
    const auto index = static_cast<std::uint32_t>(data.positions.size());
    data.positions.push_back(Vec3f(corner.position));
    data.normals.push_back(Vec3f(corner.normal));
    data.texCoords.push_back({static_cast<float>(corner.texCoord.x), static_cast<float>(corner.texCoord.y)});
    faces.corners.push_back({index, index, index, none});
  }
  faces.ends.push_back(faces.corners.size());
}

/// A side of a box: its normal, and the directions of a texture's s and t axes (ISO/IEC 19775-1, 13.3.1).
struct BoxSide {
  Vec3d normal, right, up;
};

constexpr std::array<BoxSide, 6> boxSides{{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                           {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
                                           {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                           {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                           {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                           {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};

/// The unit direction of a segment in the xz plane: from -z on, counter-clockwise as seen from above.
Vec3d directionOf(int segment) {
  const double phi = 2 * std::numbers::pi * (segment % roundSegments) / roundSegments;
  return {-std::sin(phi), 0, -std::cos(phi)};
}

class RoundSolidBuilder {
public:
  RoundSolidBuilder(const RoundSolid& solid, VertexData& data, Faces& faces)
      : solid_(solid), slope_(solid.height > 0 ? (solid.bottomRadius - solid.topRadius) / solid.height : 0),
        data_(data), faces_(faces) {}

  void addSegment(int segment) {
    const double top = solid_.topRadius, bottom = solid_.bottomRadius;
    if (solid_.hasSide) {
      const std::array corners{sideCorner(segment, 0, bottom), sideCorner(segment + 1, 0, bottom),
                               sideCorner(segment + 1, 1, top), sideCorner(segment, 1, top)};
      addFace(std::span(corners).first(top > 0 ? 4 : 3), data_, faces_);
    }
    if (solid_.hasTop && top > 0)
      addFace(std::array{capCorner(0, 0, 1), capCorner(segment, top, 1), capCorner(segment + 1, top, 1)}, data_,
              faces_);
    if (solid_.hasBottom)
      addFace(std::array{capCorner(0, 0, -1), capCorner(segment + 1, bottom, -1), capCorner(segment, bottom, -1)},
              data_, faces_);
  }

private:
  SolidCorner sideCorner(int segment, int end, double radius) const {
    const Vec3d direction = directionOf(segment), normal = direction + Vec3d{0, slope_, 0};
    return {direction * radius + Vec3d{0, (end - 0.5) * solid_.height, 0},
            normal * (1 / length(normal)),
            {static_cast<double>(segment) / roundSegments, static_cast<double>(end)}};
  }

  /// Caps show the largest circle inside the texture. `facing`: 1 for the top, -1 for the bottom.
  SolidCorner capCorner(int segment, double radius, int facing) const {
    const Vec3d direction = radius > 0 ? directionOf(segment) : Vec3d{};
    return {direction * radius + Vec3d{0, facing * solid_.height / 2, 0},
            {0, static_cast<double>(facing), 0},
            {0.5 + direction.x / 2, 0.5 - facing * direction.z / 2}};
  }

  const RoundSolid& solid_;
  double slope_;
  VertexData& data_;
  Faces& faces_;
};

} // namespace

void addBox(const Vec3d& size, VertexData& data, Faces& faces) {
  for (const BoxSide& side : boxSides) {
    const auto corner = [&](int u, int v) -> SolidCorner {
      const Vec3d unit = side.normal + side.right * (2.0 * u - 1) + side.up * (2.0 * v - 1);
      return {{size.x / 2 * unit.x, size.y / 2 * unit.y, size.z / 2 * unit.z},
              side.normal,
              {static_cast<double>(u), static_cast<double>(v)}};
    };
    addFace(std::array{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, data, faces);
  }
}

void addSphere(double radius, VertexData& data, Faces& faces) {
  constexpr int rings = roundSegments / 2;
  const auto corner = [&](int ring, int segment) -> SolidCorner {
    const double theta = std::numbers::pi * ring / rings;
    const double sine = ring == rings ? 0 : std::sin(theta); // the pole is one point
    const Vec3d normal = directionOf(segment) * sine + Vec3d{0, std::cos(theta), 0};
    return {
        normal * radius, normal, {static_cast<double>(segment) / roundSegments, 1 - static_cast<double>(ring) / rings}};
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int segment = 0; segment < roundSegments; ++segment) {
      const SolidCorner a = corner(ring, segment), b = corner(ring + 1, segment), c = corner(ring + 1, segment + 1),
                        d = corner(ring, segment + 1);
      if (ring == 0)
        addFace(std::array{a, b, c}, data, faces);
      else if (ring == rings - 1)
        addFace(std::array{a, b, d}, data, faces);
      else
        addFace(std::array{a, b, c, d}, data, faces);
    }
}

void addRoundSolid(const RoundSolid& solid, VertexData& data, Faces& faces) {
  RoundSolidBuilder builder(solid, data, faces);
  for (int segment = 0; segment < roundSegments; ++segment)
    builder.addSegment(segment);
}

} // namespace imgeo::x3d
