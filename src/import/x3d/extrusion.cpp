#include "import/x3d/extrusion.h"

#include "scene/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace imgeo::x3d {

namespace {

using Direction = std::optional<Vec3d>; ///< of unit length; empty for a zero vector

Direction unit(Vec3d vector) {
  const double size = length(vector);
  return size > 1e-12 ? Direction(vector * (1 / size)) : std::nullopt;
}

/// Replaces each missing direction by the preceding one, or by the first one at the beginning. Empty where all are
/// missing.
std::vector<Vec3d> filled(const std::vector<Direction>& directions) {
  const auto first = std::ranges::find_if(directions, [](const Direction& d) { return d.has_value(); });
  std::vector<Vec3d> all;
  if (first == directions.end())
    return all;
  Vec3d before = **first;
  for (const Direction& direction : directions)
    all.push_back(before = direction.value_or(before));
  return all;
}

/// The frame of a straight spine: the shortest rotation of the y axis onto the tangent.
Affine3d straightFrame(Vec3d tangent) {
  const Vec3d axis = cross(Vec3d{0, 1, 0}, tangent);
  const double sine = length(axis);
  if (sine > 1e-12)
    return affineOf(Rotation{axis, std::atan2(sine, tangent.y)});
  return tangent.y < 0 ? affineOf(Rotation{{1, 0, 0}, 3.14159265358979323846}) : Affine3d{};
}

/// The spine-aligned cross-section planes (13.3.5.4): y is the tangent, z the normal of the spine's bend.
std::vector<Affine3d> framesAlong(const std::vector<Vec3d>& spine) {
  const std::size_t count = spine.size();
  const bool isClosed = count > 2 && spine.front() == spine.back();
  const auto at = [&](std::size_t i, int step) {
    if (isClosed)
      return spine[(i + count - 2 + static_cast<std::size_t>(step + 1)) % (count - 1)];
    const auto index = static_cast<std::ptrdiff_t>(i) + step;
    return spine[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, std::ssize(spine) - 1))];
  };
  std::vector<Direction> tangents, bends;
  for (std::size_t i = 0; i < count; ++i) {
    tangents.push_back(unit(at(i, 1) - at(i, -1)));
    bends.push_back(unit(cross(at(i, 1) - at(i, 0), at(i, -1) - at(i, 0))));
  }
  const std::vector<Vec3d> along = filled(tangents), out = filled(bends);
  std::vector<Affine3d> frames(count);
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (out.empty()) {
      frames[i] = straightFrame(along[i]);
      continue;
    }
    Vec3d z = out[i];
    if (i > 0 && dot(z, frames[i - 1].z) < 0)
      z = z * -1;
    frames[i] = {unit(cross(along[i], z)).value_or(Vec3d{1, 0, 0}), along[i], z, {}};
  }
  return frames;
}

class Extruder {
public:
  Extruder(const Extrusion& extrusion, VertexData& data, Faces& faces)
      : extrusion_(extrusion), data_(data), faces_(faces), rows_(extrusion.spine.size()),
        columns_(extrusion.crossSection.size()) {}

  void extrude() {
    addVertices();
    addSides();
    if (extrusion_.beginCap)
      addCap(0, true);
    if (extrusion_.endCap)
      addCap(rows_ - 1, false);
  }

private:
  template <typename T> static const T& eachOrLast(const std::vector<T>& values, std::size_t i) {
    return values[std::min(i, values.size() - 1)];
  }

  void addVertices() {
    const std::vector<Affine3d> frames = framesAlong(extrusion_.spine);
    for (std::size_t i = 0; i < rows_; ++i) {
      const Vec2<double> scale = eachOrLast(extrusion_.scale, i);
      const auto& [x, y, z, angle] = eachOrLast(extrusion_.orientation, i);
      Affine3d frame = frames[i] * affineOf(Rotation{{x, y, z}, angle});
      frame.translation = extrusion_.spine[i];
      for (std::size_t j = 0; j < columns_; ++j) {
        const Vec2<double> point = extrusion_.crossSection[j];
        data_.positions.push_back(Vec3f(frame.point({point.x * scale.x, 0, point.y * scale.y})));
        data_.texCoords.push_back({static_cast<float>(j) / static_cast<float>(columns_ - 1),
                                   static_cast<float>(i) / static_cast<float>(rows_ - 1)});
      }
    }
  }

  bool ringIsClosed() const {
    return columns_ > 2 && extrusion_.crossSection.front() == extrusion_.crossSection.back();
  }

  void addSides() {
    const bool ringClosed = ringIsClosed();
    const auto last = data_.positions.begin() + static_cast<std::ptrdiff_t>((rows_ - 1) * columns_);
    const bool spineClosed = rows_ > 2 && std::equal(last, data_.positions.end(), data_.positions.begin());
    const auto corner = [&](std::size_t i, std::size_t j) {
      const std::size_t row = spineClosed ? i % (rows_ - 1) : i, column = ringClosed ? j % (columns_ - 1) : j;
      return Corner{static_cast<std::uint32_t>(row * columns_ + column), none,
                    static_cast<std::uint32_t>(i * columns_ + j), none};
    };
    for (std::size_t i = 0; i + 1 < rows_; ++i)
      for (std::size_t j = 0; j + 1 < columns_; ++j)
        addFace({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)});
  }

  void addFace(const std::vector<Corner>& corners) {
    faces_.corners.insert(faces_.corners.end(), corners.begin(), corners.end());
    faces_.ends.push_back(faces_.corners.size());
  }

  void addCap(std::size_t row, bool isTurned) {
    const std::size_t corners = ringIsClosed() ? columns_ - 1 : columns_;
    if (corners < 3)
      return;
    Vec2<double> low{extrusion_.crossSection[0]}, high{low};
    for (const Vec2<double>& point : extrusion_.crossSection) {
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    const double widest = std::max(high.x - low.x, high.y - low.y), extent = widest > 0 ? widest : 1;
    std::vector<Corner> face;
    for (std::size_t j = 0; j < corners; ++j) {
      const auto vertex = static_cast<std::uint32_t>(data_.positions.size());
      face.push_back({vertex, none, vertex, none});
      data_.positions.push_back(Vec3f(data_.positions[row * columns_ + j]));
      const Vec2<double> point = extrusion_.crossSection[j];
      const double v = (point.y - low.y) / extent;
      data_.texCoords.push_back(
          {static_cast<float>((point.x - low.x) / extent), static_cast<float>(isTurned ? v : 1 - v)});
    }
    if (isTurned)
      std::ranges::reverse(face);
    addFace(face);
  }

  const Extrusion& extrusion_;
  VertexData& data_;
  Faces& faces_;
  std::size_t rows_, columns_;
};

} // namespace

void extrude(const Extrusion& extrusion, VertexData& data, Faces& faces) {
  if (extrusion.spine.size() >= 2 && extrusion.crossSection.size() >= 2)
    Extruder(extrusion, data, faces).extrude();
}

} // namespace imgeo::x3d
