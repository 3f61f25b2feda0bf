#include "import/x3d/pop_geometry.h"

#include "base/narrow.h"
#include "containers/read_mesh.h"
#include "documents/geometry_reader.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <map>
#include <utility>

namespace imgeo::x3d {

namespace {

/// A level adds one bit to each coordinate, and coordinates have 16.
constexpr std::size_t maxPopLevels = 16;

/// The largest stored coordinate: it stands for the far end of `size`.
constexpr std::uint32_t maxPopCoord = 65535;

/// The arrays whose parts are in the files of the levels.
struct JoinedLevels {
  Bytes indices;  ///< Uint16
  Bytes vertices; ///< interleaved records of all attributes, `stride` bytes each
  std::uint32_t stride = 0, count = 0;

  const std::uint8_t* vertex(std::uint32_t n) const { return &vertices[std::size_t{n} * stride]; }
};

/// Reads the files: each has the indices that its level adds, then the vertices that it adds.
JoinedLevels joinLevels(const Source& source, const FieldReader& fields, const FetchFile& fetch) {
  struct Part {
    std::uint64_t firstVertex;
    Bytes vertices;
  };
  JoinedLevels joined;
  joined.stride = fields.integer("attributeStride", 0);
  if (joined.stride == 0)
    fields.fail(ErrorKind::malformed, "attributeStride is not stated");
  const bool isIndexed = fields.boolean("indexedRendering", true);
  std::vector<Part> parts;
  std::uint64_t count = 0;
  std::size_t levels = 0;
  for (const pugi::xml_node& child : fields.node().children()) {
    if (!equalIgnoringCase(child.name(), "PopGeometryLevel"))
      continue;
    const FieldReader level(source.documentText(), child);
    if (++levels > maxPopLevels)
      level.fail(ErrorKind::limit, fmt::format("a PopGeometry has more than {} levels", maxPopLevels));
    const std::string url = level.text("src");
    if (url.empty())
      level.fail(ErrorKind::malformed, "a PopGeometryLevel has no src");
    Bytes bytes = fetch(url);
    const std::uint64_t indices = isIndexed ? level.integer("numIndices", 0) : 0;
    if (2 * indices > bytes.size())
      level.fail(ErrorKind::truncated,
                 fmt::format("the file has {} bytes, too few for {} indices", bytes.size(), indices));
    const auto vertices = bytes.begin() + static_cast<std::ptrdiff_t>(2 * indices);
    joined.indices.insert(joined.indices.end(), bytes.begin(), vertices);
    bytes.erase(bytes.begin(), vertices);
    if (bytes.size() % joined.stride != 0)
      level.fail(ErrorKind::malformed, fmt::format("{} bytes after the indices are no whole number of vertices of {}",
                                                   bytes.size(), joined.stride));
    if (bytes.empty())
      continue;
    const std::uint64_t first = isIndexed ? level.integer("vertexDataBufferOffset", 0) : count;
    count += bytes.size() / joined.stride;
    parts.push_back({first, std::move(bytes)});
  }
  if (count > std::numeric_limits<std::uint32_t>::max())
    fields.fail(ErrorKind::limit, "a PopGeometry has more vertices than 32 bits count");
  if (count == 0)
    fields.fail(ErrorKind::malformed, "the levels have no vertices");
  joined.count = narrow<std::uint32_t>(count);
  std::ranges::stable_sort(parts, {}, &Part::firstVertex);
  for (const Part& part : parts) {
    if (part.firstVertex * joined.stride != joined.vertices.size())
      fields.fail(ErrorKind::malformed, "the vertices of levels overlap or leave a gap");
    joined.vertices.insert(joined.vertices.end(), part.vertices.begin(), part.vertices.end());
  }
  if (const std::uint32_t stated = fields.integer("vertexBufferSize", 0); isIndexed && stated > 0 && stated < count)
    fields.fail(ErrorKind::malformed,
                fmt::format("vertexBufferSize is {}, but the levels have {} vertices", stated, count));
  return joined;
}

ElementType popTypeOf(const FieldReader& fields, const char* name, ElementType fallback,
                      std::initializer_list<ElementType> known) {
  const std::string text = fields.text(name);
  if (text.empty())
    return fallback;
  for (const ElementType type : known)
    if (equalIgnoringCase(text, nameOf(type)))
      return type;
  fields.fail(ErrorKind::unsupported, fmt::format("{} \"{}\" of a PopGeometry", name, text));
}

/// Where an attribute begins in each record; empty for an optional attribute at byte 0, which means that there is none.
std::optional<ByteLocation> attributeAt(const FieldReader& fields, const char* name, const JoinedLevels& joined,
                                        std::uint32_t bytes, bool isOptional = true) {
  const std::uint32_t offset = fields.integer(name, 0);
  if (offset == 0 && isOptional)
    return {};
  if (std::uint64_t{offset} + bytes > joined.stride)
    fields.fail(ErrorKind::malformed, fmt::format("{} {} with {} bytes ends behind the attributeStride of {}", name,
                                                  offset, bytes, joined.stride));
  return ByteLocation{offset, joined.stride};
}

/// Stored coordinates count from the corner of a grid whose cells are boxes of `size`, which all shapes of a scene
/// share: the corner of the cell in which bbMin is.
Lattice popLattice(const FieldReader& fields) {
  const Vec3d size = fields.vec3("size", Vec3d{1, 1, 1}), corner = fields.vec3("bbMin", Vec3d{0, 0, 0});
  const double longest = std::max({size.x, size.y, size.z});
  if (!(std::min({size.x, size.y, size.z}) >= 0 && longest > 0))
    fields.fail(ErrorKind::malformed, "size is the extent of no box");
  Lattice lattice{corner, longest / maxPopCoord, 32, size * (1 / longest)};
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > 0)
      lattice.origin[axis] = std::floor(corner[axis] / size[axis]) * size[axis];
    if (!(std::abs(lattice.origin[axis]) + 2 * size[axis] <= double{std::numeric_limits<float>::max()}))
      fields.fail(ErrorKind::malformed, "bbMin and size are beyond the range of Float32");
  }
  return lattice;
}

/// The coordinates as Uint32. A shape that reaches into the next cell of the grid has coordinates that begin again at
/// 0: those up to bbMaxModF are moved on by one cell.
Bytes popCoords(const FieldReader& fields, const JoinedLevels& joined, std::uint32_t offset) {
  const Vec3f min = fields.vec3("bbMinModF", Vec3f{0, 0, 0}), max = fields.vec3("bbMaxModF", Vec3f{1, 1, 1}),
              shift = fields.vec3("bbShiftVec", Vec3f{0, 0, 0});
  Vec3u cells;
  for (int axis = 0; axis < 3; ++axis) {
    if (shift[axis] != 0 && shift[axis] != 1)
      fields.fail(ErrorKind::malformed, "bbShiftVec is neither 0 nor 1");
    cells[axis] = min[axis] > max[axis] || shift[axis] == 1 ? 1 : 0;
  }
  Bytes coords;
  for (std::uint32_t n = 0; n < joined.count; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t q = loadLittle<std::uint16_t>(joined.vertex(n) + offset + std::ptrdiff_t{2} * axis);
      const bool isInNextCell = static_cast<float>(q) / float{maxPopCoord} <= max[axis];
      appendLittle(coords, q + (isInNextCell ? cells[axis] * maxPopCoord : 0));
    }
  return coords;
}

/// The normals as Float32; stored are unsigned integers over -1 .. 1.
Bytes popNormals(const JoinedLevels& joined, std::uint32_t offset, ElementType type) {
  Bytes normals;
  for (std::uint32_t n = 0; n < joined.count; ++n)
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint8_t* at = joined.vertex(n) + offset + std::size_t{axis} * byteSizeOf(type);
      const double stored = type == ElementType::uint8 ? *at : loadLittle<std::uint16_t>(at);
      appendLittle(normals, static_cast<float>(2 * stored / maximumOf(type) - 1));
    }
  return normals;
}

} // namespace

Mesh readPopGeometry(const Source& source, pugi::xml_node node, const FetchFile& fetch) {
  using enum ElementType;
  const FieldReader fields(source.documentText(), node);
  const std::string location = source.locationOf(node);
  JoinedLevels joined = joinLevels(source, fields, fetch);

  // Joined, the levels are the arrays of a BinaryGeometry, whose reader checks the indices.
  GeometryDescription geometry;
  PatchDescription patch;
  std::map<std::string, Bytes> arrays;
  const auto add = [&](const char* name, Bytes bytes) {
    const std::string url = location + ", " + name + " of all levels";
    arrays.emplace(url, std::move(bytes));
    return url;
  };
  geometry.encoding = Encoding::bg;
  geometry.ccw = fields.boolean("ccw", true);
  geometry.lattice = popLattice(fields);
  geometry.coordType = uint32;
  patch.vertexCount = joined.count;
  patch.draws = readDraws(fields, fields);
  if (fields.boolean("indexedRendering", true))
    patch.index = Reference{add("indices", std::exchange(joined.indices, {})), ByteLocation{}};
  else if (patch.draws.size() == 1 && patch.draws[0].count == 0)
    patch.draws[0].count = joined.count;

  popTypeOf(fields, "coordType", uint16, {uint16});
  const bool isSpherical = fields.boolean("sphericalNormals", false);
  const ByteLocation position = *attributeAt(fields, "positionOffset", joined, isSpherical ? 8 : 6, false);
  patch.coord = {{add("coordinates", popCoords(fields, joined, position.byteOffset)), ByteLocation{}}};
  const ElementType normalType = popTypeOf(fields, "normalType", uint8, {uint8, uint16});
  const std::optional<ByteLocation> normal = attributeAt(fields, "normalOffset", joined, 3 * byteSizeOf(normalType));
  if (!isSpherical && normal) {
    geometry.attributeTypes[VertexRole::normal] = float32;
    patch.vertexAttributes[VertexRole::normal] =
        Reference{add("normals", popNormals(joined, normal->byteOffset, normalType)), ByteLocation{}};
  }
  const std::string records = add("vertices", std::exchange(joined.vertices, {}));
  if (isSpherical) {
    geometry.normalEncoding = NormalEncoding::spherical;
    geometry.attributeTypes[VertexRole::normal] = uint8;
    patch.vertexAttributes[VertexRole::normal] = Reference{records, normalInCoords(position)};
  }
  const auto read = [&](VertexRole role, const char* type, const char* offset, ElementType fallback,
                        std::uint32_t components) {
    geometry.attributeTypes[role] = popTypeOf(fields, type, fallback, {uint8, uint16, float32});
    const std::uint32_t bytes = components * byteSizeOf(geometry.attributeTypes[role]);
    if (const std::optional<ByteLocation> begin = attributeAt(fields, offset, joined, bytes))
      patch.vertexAttributes[role] = Reference{records, *begin};
  };
  read(VertexRole::texCoord, "texCoordType", "texcoordOffset", uint16, 2);
  read(VertexRole::color, "colorType", "colorOffset", uint8, geometry.colorComponents);
  geometry.patches = {patch};
  return readMesh(ContainerReader([&](const std::string& url) { return arrays.at(url); }), geometry, location);
}

} // namespace imgeo::x3d
