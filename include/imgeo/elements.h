#pragma once
/// @file
/// Kinds of elements that meshes are drawn with, and their counts.

#include <cstddef>
#include <cstdint>

namespace imgeo {

/// Kind of the elements of a mesh. The value is the number of an element's corners.
enum class Topology : std::uint8_t {
  points = 1,    ///< a vertex each
  lines = 2,     ///< two vertices each
  triangles = 3, ///< three vertices each
};

/// Number of corners of an element.
inline constexpr std::uint32_t cornersPerElement(Topology topology) {
  return static_cast<std::uint32_t>(topology);
}

/// Every kind of element.
inline constexpr Topology allTopologies[] = {Topology::triangles, Topology::lines, Topology::points};

/// "points", "lines", "triangles".
const char* nameOf(Topology topology);

/// Number of elements of each kind.
struct ElementCounts {
  std::size_t triangles = 0; ///< number of triangles
  std::size_t lines = 0;     ///< number of line segments
  std::size_t points = 0;    ///< number of points

  /// The count of one kind.
  std::size_t& of(Topology topology) {
    return topology == Topology::triangles ? triangles : topology == Topology::lines ? lines : points;
  }
  /// The count of one kind.
  std::size_t of(Topology topology) const { return ElementCounts(*this).of(topology); }
  /// The count of all kinds together.
  std::size_t sum() const { return triangles + lines + points; }
  /// Adds the counts of each kind.
  ElementCounts& operator+=(const ElementCounts& other) {
    triangles += other.triangles;
    lines += other.lines;
    points += other.points;
    return *this;
  }
  /// Whether all counts are equal.
  friend bool operator==(const ElementCounts&, const ElementCounts&) = default;
};

} // namespace imgeo
