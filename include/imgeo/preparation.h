#pragma once
/// @file
/// What a conversion does to meshes before it encodes them.

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>

namespace imgeo {

/// Elements to leave out. By default all are kept.
struct DroppedElements {
  bool degenerate = false; ///< elements with two corners at one position
  bool repeated = false;   ///< elements with the same corners in the same cyclic order as an earlier one
};

/// How triangles are weighted in a computed vertex normal.
enum class NormalWeighting {
  area,    ///< by area; compact predicts these best
  angle,   ///< by the angle at the vertex (Thürmer & Wüthrich 1998)
  uniform, ///< all alike (Gouraud 1971)
};

/// Which further vertex attributes of a source (other than normals, texture coordinates and colours) are kept.
struct AttributeChoice {
  bool all = false;            ///< keep all
  std::set<std::string> names; ///< keep these, where `all` is false

  /// Whether the attribute of this name is kept.
  bool has(const std::string& name) const { return all || names.contains(name); }
};

/// The crease angle of man-made objects: their edges are sharper, and the facets of their curved surfaces meet at less.
inline constexpr double manMadeCreaseDegrees = 39;

/// Triangle meshes that have no normals in the source, by what was done about their edges.
struct EdgeReport {
  std::size_t guessedSharp = 0;  ///< nothing states it, and they seem to be man-made objects: edges are sharp
  std::size_t guessedSmooth = 0; ///< nothing states it, and they do not: edges are smooth
  std::size_t flat = 0; ///< all edges are sharp, so these meshes have no normals, and viewers draw triangles flat

  /// Adds the meshes of another part of a source.
  EdgeReport& operator+=(const EdgeReport& other) {
    guessedSharp += other.guessedSharp;
    guessedSmooth += other.guessedSmooth;
    flat += other.flat;
    return *this;
  }
};

/// What welding merged, dropped and found.
struct WeldReport {
  std::size_t mergedPositions = 0;       ///< positions that had the bits of another one
  std::size_t mergedWedges = 0;          ///< wedges (position and attributes) that were equal to another one
  std::size_t unreferencedPositions = 0; ///< positions that no kept element uses; they are dropped
  std::size_t degenerateElements = 0;    ///< found, whether kept or dropped
  std::size_t duplicateElements = 0;     ///< elements that repeat an earlier one: found, whether kept or dropped
};

} // namespace imgeo
