#pragma once
// Attributes of the wedges of a mesh or the vertices of a patch: all vertex data except positions.

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace imgeo {

/// A vertex attribute other than those of VertexRole, such as a quantity of a scan or a simulation. The source names
/// it.
struct NamedAttribute {
  std::string name;
  std::uint32_t components = 1; ///< 1..4
  std::vector<float> values;    ///< `components` for each wedge, finite

  std::size_t count() const { return values.size() / components; }
  friend bool operator==(const NamedAttribute&, const NamedAttribute&) = default;
};

/// The attributes that shaders and file formats know by their meaning, in the order in which files and documents list
/// them.
enum class VertexRole : std::uint8_t { normal, texCoord, texCoord1, texCoord2, texCoord3, color };

inline constexpr std::array vertexRoles{VertexRole::normal,    VertexRole::texCoord,  VertexRole::texCoord1,
                                        VertexRole::texCoord2, VertexRole::texCoord3, VertexRole::color};

/// Texture coordinates, by set. Each texture of an appearance names the set that it uses.
inline constexpr std::array texCoordRoles{VertexRole::texCoord, VertexRole::texCoord1, VertexRole::texCoord2,
                                          VertexRole::texCoord3};
inline constexpr std::size_t maxTexCoordSets = texCoordRoles.size();

constexpr bool isTexCoord(VertexRole role) {
  return role >= texCoordRoles.front() && role <= texCoordRoles.back();
}

/// The number of a set: 0 for texCoord, 1 for texCoord1 ...
constexpr std::size_t texCoordSetOf(VertexRole role) {
  return static_cast<std::size_t>(role) - static_cast<std::size_t>(VertexRole::texCoord);
}

/// One value for each of these attributes.
template <typename T> struct ByVertexRole {
  std::array<T, vertexRoles.size()> values{};

  constexpr T& operator[](VertexRole role) { return values[static_cast<std::size_t>(role)]; }
  constexpr const T& operator[](VertexRole role) const { return values[static_cast<std::size_t>(role)]; }
  friend bool operator==(const ByVertexRole&, const ByVertexRole&) = default;
};

/// All attributes, with one value for each wedge; an absent attribute is empty.
struct VertexAttributes {
  std::vector<Vec3f> normals;   ///< unit length
  std::vector<Vec2f> texCoords; ///< set 0; a further set is present only if all sets before it are
  std::vector<Vec2f> texCoords1, texCoords2, texCoords3;
  /// The names of the sets of texture coordinates, by which textures choose theirs; may be empty if there is one set.
  std::vector<std::string> texCoordMappings;
  std::vector<Rgba> colors;
  std::uint32_t colorComponents = 3;           ///< 3: every alpha is 1; 4: with alpha
  std::vector<NamedAttribute> namedAttributes; ///< with unique names
};

/// The properties of one attribute, for code that handles all of them in the same way.
template <typename Value> struct VertexAttributeRow {
  VertexRole role;
  const char* name;     ///< role of its files, and field of X3D nodes
  const char* plural;   ///< in messages
  const char* gltfName; ///< name of the attribute of a glTF primitive
  std::vector<Value> VertexAttributes::*values;
  Value missing; ///< value that append() gives to vertices without the attribute
};

/// One row for each VertexRole, in its order.
inline constexpr std::tuple vertexAttributeTable{
    VertexAttributeRow<Vec3f>{VertexRole::normal, "normal", "normals", "NORMAL", &VertexAttributes::normals, {0, 0, 1}},
    VertexAttributeRow<Vec2f>{
        VertexRole::texCoord, "texCoord", "texture coordinates", "TEXCOORD_0", &VertexAttributes::texCoords, {0, 0}},
    VertexAttributeRow<Vec2f>{VertexRole::texCoord1,
                              "texCoord1",
                              "texture coordinates of set 1",
                              "TEXCOORD_1",
                              &VertexAttributes::texCoords1,
                              {0, 0}},
    VertexAttributeRow<Vec2f>{VertexRole::texCoord2,
                              "texCoord2",
                              "texture coordinates of set 2",
                              "TEXCOORD_2",
                              &VertexAttributes::texCoords2,
                              {0, 0}},
    VertexAttributeRow<Vec2f>{VertexRole::texCoord3,
                              "texCoord3",
                              "texture coordinates of set 3",
                              "TEXCOORD_3",
                              &VertexAttributes::texCoords3,
                              {0, 0}},
    VertexAttributeRow<Rgba>{VertexRole::color, "color", "colours", "COLOR_0", &VertexAttributes::colors,
                             Rgba(1, 1, 1, 1)},
};
static_assert(std::tuple_size_v<decltype(vertexAttributeTable)> == vertexRoles.size());

/// The row of a role that is known at compile time.
template <VertexRole role>
inline constexpr const auto& attributeRow = std::get<static_cast<std::size_t>(role)>(vertexAttributeTable);

/// Calls visit(row) for each row of the table.
template <typename Visit> constexpr void visitAttributeRows(Visit visit) {
  std::apply([&](const auto&... rows) { (visit(rows), ...); }, vertexAttributeTable);
}

/// Calls visit(row, values) for each row of the table, also where `values` is empty. `Attributes` is VertexAttributes
/// or derived from it, const or not.
template <typename Attributes, typename Visit> constexpr void visitAttributes(Attributes& attributes, Visit visit) {
  visitAttributeRows([&](const auto& row) { visit(row, attributes.*row.values); });
}

/// Calls visit(row, valuesOfFirst, valuesOfSecond) likewise.
template <typename First, typename Second, typename Visit>
constexpr void visitAttributes(First& first, Second& second, Visit visit) {
  visitAttributeRows([&](const auto& row) { visit(row, first.*row.values, second.*row.values); });
}

/// The texture coordinates of a set below maxTexCoordSets.
inline constexpr std::array texCoordMembers{&VertexAttributes::texCoords, &VertexAttributes::texCoords1,
                                            &VertexAttributes::texCoords2, &VertexAttributes::texCoords3};
template <typename Attributes> constexpr auto& texCoordsOf(Attributes& attributes, std::size_t set) {
  return attributes.*texCoordMembers[set];
}

/// The number of sets of texture coordinates that are present.
std::size_t texCoordSetCount(const VertexAttributes& attributes);

/// The set that a texture with a mapping uses: the one of this name, or else the first (X3D 4, 18.4: `mapping`).
std::size_t texCoordSetNamed(const std::string& mapping, const VertexAttributes& attributes);

/// "normal", "texCoord", "texCoord1", ... "color".
const char* nameOf(VertexRole role);

/// Whether the attribute is present.
bool hasAttribute(const VertexAttributes& attributes, VertexRole role);

/// Whether any attribute is present, named ones included.
bool hasAnyAttribute(const VertexAttributes& attributes);

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
/// the other has, its values are VertexAttributeRow::missing, or zeros for named attributes.
void append(VertexAttributes& attributes, std::size_t count, const VertexAttributes& more, std::size_t moreCount);

/// Whether every attribute that is present has values for `count` vertices, and names are unique.
bool isConsistent(const VertexAttributes& attributes, std::size_t count);

} // namespace imgeo
