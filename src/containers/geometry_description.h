#pragma once
// The description of one geometry in a document: its lattice, its patches and the references to their files. Encoders
// produce it, documents store it, decoders use it.
// docs/formats/nodes.md specifies its text form.

#include "containers/levels/level_index.h"
#include "containers/reference.h"
#include "imgeo/encoding.h"
#include "prepare/geometry_image/surface_distance.h"
#include "prepare/lattice.h"
#include "prepare/primitives.h"
#include "scene/operators.h"
#include "scene/vertex_attributes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// The contents of a file; `info` sums bytes by role.
enum class Role : std::uint8_t {
  index,
  coord,
  normal,
  texCoord,
  texCoord1,
  texCoord2,
  texCoord3,
  color,
  attribute,
  patch,
  base,
  levels, ///< an index of levels, and its further pages
  chips   ///< the image of a group of levels
};

/// "index", "coord" ...: the names of fields in documents.
const char* nameOf(Role role);

/// The role of the files of a vertex attribute.
constexpr Role fileRoleOf(VertexRole role) {
  return static_cast<Role>(static_cast<std::size_t>(Role::normal) + static_cast<std::size_t>(role));
}
static_assert(fileRoleOf(vertexRoles.back()) == Role::color &&
              static_cast<std::size_t>(Role::attribute) == static_cast<std::size_t>(Role::normal) + vertexRoles.size());

/// The vertex attribute that files of a role hold, if any.
std::optional<VertexRole> vertexRoleOf(Role role);

/// "POINTS", "TRIANGLESTRIP" ...: values of X3DOM's `primType`.
const char* nameOf(Primitive primitive);

std::uint32_t byteSizeOf(ElementType type);

/// What the texels of a grid are, a vertex each (docs/formats/nodes.md, "Grids").
enum class GridKind : std::uint8_t {
  heightMap,     ///< heights: y; x and z follow from column and row
  geometryImage, ///< points of a surface
  sculpt         ///< points of a surface whose last column is joined to its first
};

/// "heightMap", "geometryImage", "sculpt": values of `implicitMeshMode`.
const char* nameOf(GridKind kind);

/// The number of triangles of a grid of at least 2 x 2 vertices.
std::uint64_t gridTriangleCount(GridKind kind, Vec2<std::uint32_t> size);

struct PatchDescription {
  Box3d box;                     ///< tight, for culling and priority
  std::uint32_t vertexCount = 0; ///< records in coord, normal, ...; 0: the largest index + 1
  std::vector<Draw> draws;
  Vec2<std::uint32_t> implicitMeshSize{256, 256}; ///< classic: columns and rows that indices fill
  Vec2<std::uint32_t> gridOrigin;                 ///< height maps: column and row of the first vertex in the whole map
  std::optional<Reference> index;                 ///< nothing: records are drawn in order
  std::vector<Reference> coord;                   ///< classic: byte planes, most significant first. bg: one
  ByVertexRole<std::optional<Reference>> vertexAttributes;
  /// Classic: further images of an attribute, each with the next lower byte of its numbers.
  ByVertexRole<std::vector<Reference>> lowBytes;
  std::vector<std::vector<Reference>> attributes; ///< per attribute of the geometry: byte planes (classic) or one (bg)
  std::optional<Reference> data;                  ///< compact: the whole patch
  friend bool operator==(const PatchDescription&, const PatchDescription&) = default;
};

/// Calls visit(role, reference) for every reference of a patch.
template <typename Patch, typename Visit> void visitReferences(Patch& patch, Visit visit) {
  if (patch.index)
    visit(Role::index, *patch.index);
  for (auto& plane : patch.coord)
    visit(Role::coord, plane);
  for (const VertexRole role : vertexRoles)
    if (auto& reference = patch.vertexAttributes[role]) {
      visit(fileRoleOf(role), *reference);
      for (auto& plane : patch.lowBytes[role])
        visit(fileRoleOf(role), plane);
    }
  for (auto& planes : patch.attributes)
    for (auto& plane : planes)
      visit(Role::attribute, plane);
  if (patch.data)
    visit(Role::patch, *patch.data);
}

/// A further vertex attribute: one FloatVertexAttribute.
struct AttributeDescription {
  std::string name;
  std::uint32_t components = 1; ///< 1..4
  std::uint32_t bytes = 2;      ///< SIG: bytes of each number, 1..3. bg stores Float32
  /// Per component. SIG: the range over which stored integers 0 .. 256^bytes - 1 are spread. bg: the range of the
  /// numbers.
  std::vector<double> min, size;
  friend bool operator==(const AttributeDescription&, const AttributeDescription&) = default;
};

/// The range of a set of texture coordinates, relative to which they are stored.
struct TexCoordBox {
  Vec2f min{0, 0}, size{1, 1};
  friend bool operator==(const TexCoordBox&, const TexCoordBox&) = default;
};

/// Bits of a stored component in images of which a node states nothing else: SIG of version 1.
inline constexpr ByVertexRole<std::uint32_t> defaultImageBits{{8, 16, 16, 16, 16, 8}};

/// The levels of detail of a geometry: docs/formats/levels.md.
struct LevelsDescription {
  std::string url;                         ///< of the index, relative to the document
  Topology topology = Topology::triangles; ///< of the groups' elements: triangles or points
  LevelIndex index{};                      ///< see readLevels(); without groups before
  /// The set of texture coordinates of the groups' images, 1 or more; 0: they have none.
  std::uint32_t chipSet = 0;
  friend bool operator==(const LevelsDescription&, const LevelsDescription&) = default;
};

/// The fields of one ImageGeometry or BinaryGeometry node.
struct GeometryDescription {
  Encoding encoding = Encoding::classic;
  Lattice lattice; ///< `position` and `size` follow from it: see decodeFields
  Box3d box;       ///< tight box of all patches
  std::array<TexCoordBox, maxTexCoordSets> texCoordBoxes;
  std::vector<std::string> texCoordMappings; ///< names of the sets, as VertexAttributes has them
  std::uint32_t colorComponents = 3;
  ElementType indexType = ElementType::uint16; ///< bg and classic, which has uint16 and uint32
  ElementType coordType = ElementType::uint16; ///< bg only
  ByVertexRole<ElementType> attributeTypes{{ElementType::int8, ElementType::uint16, ElementType::uint16,
                                            ElementType::uint16, ElementType::uint16, ElementType::uint8}}; ///< bg only
  NormalEncoding normalEncoding = NormalEncoding::rgb;
  ByVertexRole<std::uint32_t> imageBits = defaultImageBits; ///< classic only: bits of a stored component
  bool ccw = true;                                          ///< false: the front of triangles is clockwise
  bool isFlat = false; ///< BG: triangles are shaded by their slope, as X3DOM does without normalPerVertex
  /// Classic: every patch is a grid of implicitMeshSize vertices, without an index. The lattice of a
  /// height map is heightMapLattice(); its patches are parts of one map, and neighbours share a column or a row.
  std::optional<GridKind> grid;
  /// The distance of grids that were sampled from a mesh from its surface.
  std::optional<SurfaceDistance> surfaceDistance;
  std::vector<Operator> operators; ///< map the decoded vertices; readMesh() applies them
  std::vector<AttributeDescription> attributes;
  std::vector<PatchDescription> patches;
  std::optional<Reference> base; ///< compact: base mesh, drawn until the patches are decoded
  /// Compact: then `patches` are the groups of one level, which documents do not name, and `base` is the root.
  std::optional<LevelsDescription> levels;
  /// The document has one node for this and other geometries, which differ in the index of their only patch. Lattice
  /// and boxes are those of all of them.
  bool isShared = false;
  /// Where draws have several kinds of elements, the only kind that is decoded: see splitByTopology().
  std::optional<Topology> topology;
  friend bool operator==(const GeometryDescription&, const GeometryDescription&) = default;
};

/// Classic: the number of images of an attribute of so many bits a component; 0 for bits that images do not hold.
/// Texture coordinates and pairs of 16 bits are in one image, other numbers in one for each byte.
std::size_t imageCountOf(VertexRole role, NormalEncoding normals, std::uint32_t bits);
/// Classic: the bits of a component in so many images, unless the node states others.
std::uint32_t bitsOfImages(VertexRole role, NormalEncoding normals, std::size_t imageCount);

/// The reference to normals in the fourth element of 16-bit coordinates, where X3DOM has spherical normals. `coord` has
/// a ByteLocation.
ByteLocation normalInCoords(const ByteLocation& coord);
Reference normalInCoords(const Reference& coord);

/// Whether the normals of every patch are X3DOM's normalAsSphericalCoordinates.
bool hasNormalsInCoords(const GeometryDescription& geometry);

/// Whether a geometry draws triangles as well as lines, or points.
bool drawsSeveralTopologies(const GeometryDescription& geometry);

/// A geometry for each kind of element that the draws of a geometry have, in the order of the first draws, with the
/// patches that have such draws; the geometry itself where they have one kind.
std::vector<GeometryDescription> splitByTopology(const GeometryDescription& geometry);

bool isUnsigned(ElementType type);
/// The integer that stands for 1: 127, 255, 32767, 65535 ...; 1 for Float32.
double maximumOf(ElementType type);

} // namespace imgeo
