#pragma once
// What a wedge of a mesh, or a vertex of what is drawn, has besides its place.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A further attribute by the name that its source gives it: what a scanner or a
/// simulation measured at every vertex.
struct NamedAttribute {
  std::string name;
  std::uint32_t components = 1; ///< 1..4
  std::vector<float> values;    ///< `components` a wedge, finite

  std::size_t count() const { return values.size() / components; }
  friend bool operator==(const NamedAttribute&, const NamedAttribute&) = default;
};

/// All of them, one a wedge each; an attribute that is not there is empty.
struct VertexAttributes {
  std::vector<Vec3f> normals; ///< unit length
  std::vector<Vec2f> texCoords;
  std::vector<Rgba8> colors;
  std::uint32_t colorComponents = 3;           ///< 3: every alpha is 255; 4: alpha counts
  std::vector<NamedAttribute> namedAttributes; ///< no two of one name
};

/// values[from[0]], values[from[1]], ...; nothing of what is not there.
template <typename T> std::vector<T> gather(const std::vector<T>& values, std::span<const std::uint32_t> from) {
  std::vector<T> result;
  if (values.empty())
    return result;
  result.reserve(from.size());
  for (const std::uint32_t i : from)
    result.push_back(values[i]);
  return result;
}
VertexAttributes gather(const VertexAttributes& attributes, std::span<const std::uint32_t> from);

/// Appends what `more` has of `moreCount` vertices to what `attributes` has of
/// `count`. Normals (0, 0, 1), white and zeros stand for what one of them lacks.
void append(VertexAttributes& attributes, std::size_t count, const VertexAttributes& more, std::size_t moreCount);

/// Whether every attribute that is there is one a vertex, and no two have one name.
bool isConsistent(const VertexAttributes& attributes, std::size_t count);

} // namespace imgeo
