#include "containers/normal_palette.h"

#include "base/parallel.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <numbers>

namespace imgeo {

namespace {

constexpr std::size_t paletteSize = 256;
constexpr std::uint32_t cellBits = 9; ///< normals are gathered in octahedral cells of about 0.3 degrees
constexpr int rounds = 24;

/// Normals that share an octahedral cell: their sum, and the index of the direction nearest to it.
struct Cell {
  Vec3d sum;
  std::size_t nearest = 0;
};

std::vector<Cell> occupiedCells(std::span<const Vec3f> normals) {
  std::vector<Vec3d> sums(std::size_t{1} << (2 * cellBits));
  std::vector<bool> occupied(sums.size());
  for (const Vec3f& normal : normals) {
    const Vec2<std::uint32_t> code = octahedralFromUnit(normal, cellBits);
    const std::size_t at = std::size_t{code.y} << cellBits | code.x;
    sums[at] += Vec3d(normal);
    occupied[at] = true;
  }
  std::vector<Cell> cells;
  for (std::size_t at = 0; at < sums.size(); ++at)
    if (occupied[at])
      cells.push_back({sums[at], 0});
  return cells;
}

/// Evenly spread directions: the spherical Fibonacci lattice (Swinbank & Purser 2006).
std::vector<Vec3d> spreadDirections() {
  std::vector<Vec3d> directions;
  const double goldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < paletteSize; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / paletteSize, radius = std::sqrt(1 - z * z);
    const double angle = goldenAngle * static_cast<double>(i);
    directions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return directions;
}

std::size_t nearestOf(const std::vector<Vec3d>& directions, Vec3d v) {
  std::size_t best = 0;
  double bestCosine = dot(directions[0], v);
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const double cosine = dot(directions[i], v);
    if (cosine > bestCosine) {
      bestCosine = cosine;
      best = i;
    }
  }
  return best;
}

void assignNearest(std::vector<Cell>& cells, const std::vector<Vec3d>& directions) {
  parallelFor(cells.size(), [&](std::size_t i) { cells[i].nearest = nearestOf(directions, cells[i].sum); });
}

/// Moves every direction to the mean of its cells; a direction without cells moves to the cell with the largest error.
void moveToMeans(std::vector<Cell>& cells, std::vector<Vec3d>& directions) {
  std::vector<Vec3d> sums(directions.size());
  for (const Cell& cell : cells)
    sums[cell.nearest] += cell.sum;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    double norm = length(sums[i]);
    if (norm == 0) {
      const auto loss = [&](const Cell& cell) { return length(cell.sum) - dot(cell.sum, directions[cell.nearest]); };
      Cell& worst = *std::ranges::max_element(cells, {}, loss);
      worst.nearest = i;
      sums[i] = worst.sum;
      norm = length(sums[i]);
    }
    if (norm > 0)
      directions[i] = sums[i] * (1 / norm);
  }
}

/// Sorts directions along a Morton curve over the unfolded octahedron.
void sortAlongMortonCurve(std::vector<Vec3d>& directions) {
  const auto key = [](Vec3d direction) {
    const Vec2<std::uint32_t> code = octahedralFromUnit(Vec3f(direction), 8);
    std::uint32_t morton = 0;
    for (int bit = 7; bit >= 0; --bit)
      morton = morton << 2 | (code.y >> bit & 1) << 1 | (code.x >> bit & 1);
    return morton;
  };
  std::ranges::stable_sort(directions, {}, key);
}

Rgba8 colorOf(Vec3d direction) {
  const auto byte = [](double component) {
    return static_cast<std::uint8_t>(std::lround((std::clamp(component, -1.0, 1.0) + 1) * 127.5));
  };
  return {byte(direction.x), byte(direction.y), byte(direction.z), 255};
}

} // namespace

NormalPalette normalPalette(std::span<const Vec3f> normals) {
  NormalPalette palette;
  std::vector<Vec3d> directions = spreadDirections();
  std::vector<Cell> cells = occupiedCells(normals);
  for (int round = 0; round < rounds && !cells.empty(); ++round) {
    assignNearest(cells, directions);
    moveToMeans(cells, directions);
  }
  sortAlongMortonCurve(directions);
  for (std::size_t i = 0; i < paletteSize; ++i)
    palette.colors[i] = colorOf(directions[i]);
  palette.indices.resize(normals.size());
  parallelFor(normals.size(), [&](std::size_t i) {
    palette.indices[i] = static_cast<std::uint8_t>(nearestOf(directions, Vec3d(normals[i])));
  });
  return palette;
}

} // namespace imgeo
