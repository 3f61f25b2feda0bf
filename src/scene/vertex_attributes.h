#pragma once
// Attributes of the wedges of a mesh or the vertices of a patch: all vertex data except positions.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A further vertex attribute with the name that its source gives it, such as a quantity of a scan or a simulation.
struct NamedAttribute {
  std::string name;
  std::uint32_t components = 1; ///< 1..4
  std::vector<float> values;    ///< `components` for each wedge, finite

  std::size_t count() const { return values.size() / components; }
  friend bool operator==(const NamedAttribute&, const NamedAttribute&) = default;
};

/// All attributes, with one value for each wedge; an absent attribute is empty.
struct VertexAttributes {
  std::vector<Vec3f> normals; ///< unit length
  std::vector<Vec2f> texCoords;
  std::vector<Rgba8> colors;
  std::uint32_t colorComponents = 3;           ///< 3: every alpha is 255; 4: with alpha
  std::vector<NamedAttribute> namedAttributes; ///< with unique names
};

/// The values at the given indices; empty for an absent attribute.
template <typename T> std::vector<T> gather(const std::vector<T>& values, std::span<const std::uint32_t> indices) {
  std::vector<T> result;
  if (values.empty())
    return result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices)
    result.push_back(values[i]);
  return result;
}
VertexAttributes gather(const VertexAttributes& attributes, std::span<const std::uint32_t> indices);

/// Appends the attributes of `moreCount` vertices to those of `count` vertices. Where one side lacks an attribute that
/// the other has, its values are the normal (0, 0, 1), white or zeros.
void append(VertexAttributes& attributes, std::size_t count, const VertexAttributes& more, std::size_t moreCount);

/// Whether every attribute that is present has `count` values, and names are unique.
bool isConsistent(const VertexAttributes& attributes, std::size_t count);

} // namespace imgeo
