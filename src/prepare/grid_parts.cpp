#include "prepare/grid_parts.h"

#include "base/narrow.h"

#include <cassert>

namespace imgeo {

namespace {

/// A range of columns or rows.
struct GridRange {
  std::uint32_t first, count;
};

std::vector<GridRange> rangesOf(std::uint32_t vertices, std::uint32_t maxVertices) {
  assert(vertices >= 2 && maxVertices >= 2);
  const std::uint32_t cells = vertices - 1, parts = (cells + maxVertices - 2) / (maxVertices - 1);
  const auto firstOf = [&](std::uint64_t part) { return narrow<std::uint32_t>(part * cells / parts); };
  std::vector<GridRange> ranges;
  for (std::uint32_t part = 0; part < parts; ++part)
    ranges.push_back({firstOf(part), firstOf(part + 1) - firstOf(part) + 1});
  return ranges;
}

} // namespace

std::vector<GridPart> gridParts(Vec2<std::uint32_t> size, std::uint32_t maxEdge) {
  std::vector<GridPart> parts;
  for (const GridRange& rows : rangesOf(size.y, maxEdge))
    for (const GridRange& columns : rangesOf(size.x, maxEdge))
      parts.push_back({{columns.first, rows.first}, {columns.count, rows.count}});
  return parts;
}

std::vector<std::uint32_t> verticesOf(const GridPart& part, std::uint32_t columns) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(std::size_t{part.size.x} * part.size.y);
  for (std::uint32_t row = 0; row < part.size.y; ++row)
    for (std::uint32_t column = 0; column < part.size.x; ++column)
      vertices.push_back((part.origin.y + row) * columns + part.origin.x + column);
  return vertices;
}

} // namespace imgeo
