#include "documents/geometry_reader.h"

#include "containers/compact/compact_patch.h"
#include "containers/encodings.h"
#include "containers/grid.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "documents/field_messages.h"
#include "documents/geometry_element.h"
#include "documents/grid_reader.h"
#include "documents/patch_references.h"
#include "documents/vertex_attribute_reader.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <span>
#include <sstream>

namespace imgeo {

namespace {

/// The names of `primType`: strings, or words without quotes.
std::vector<std::string> primitiveNames(const FieldReader& fields) {
  std::vector<std::string> names;
  for (std::string text : fields.strings("primType")) {
    std::ranges::replace(text, ',', ' ');
    std::istringstream words(text);
    names.insert(names.end(), std::istream_iterator<std::string>(words), {});
  }
  return names;
}

constexpr std::array elementTypes{ElementType::int8,  ElementType::uint8,  ElementType::int16,  ElementType::uint16,
                                  ElementType::int32, ElementType::uint32, ElementType::float32};
constexpr std::array imageIndexTypes{ElementType::uint16, ElementType::uint32};
constexpr std::array normalEncodings{NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical,
                                     NormalEncoding::palette};

/// The choice that a field names; the fallback where it is absent. Throws Error{unsupported} for another name.
template <typename Choice>
Choice choiceOf(const FieldReader& fields, const char* name, std::span<const Choice> choices, Choice fallback) {
  const std::string text = fields.text(name);
  if (text.empty())
    return fallback;
  const auto found =
      std::ranges::find_if(choices, [&](Choice choice) { return equalIgnoringCase(text, nameOf(choice)); });
  if (found != choices.end())
    return *found;
  std::vector<const char*> names;
  std::ranges::transform(choices, std::back_inserter(names), [](Choice choice) { return nameOf(choice); });
  failChoice(fields, name, names);
}

Primitive primitiveNamed(const FieldReader& fields, const std::string& name) {
  for (const Primitive primitive : {Primitive::points, Primitive::lines, Primitive::lineStrip, Primitive::lineLoop,
                                    Primitive::triangles, Primitive::triangleStrip, Primitive::triangleFan})
    if (equalIgnoringCase(name, nameOf(primitive)))
      return primitive;
  fields.warnOrFail(
      fmt::format(
          "primType \"{}\" is none of POINTS, LINES, LINESTRIP, LINELOOP, TRIANGLES, TRIANGLESTRIP, TRIANGLEFAN",
          shortened(name)),
      "TRIANGLES are drawn");
  return Primitive::triangles;
}

PatchDescription readPatch(const DocumentText& source, const pugi::xml_node& node, const GeometryDescription& geometry,
                           DocumentWarnings* warnings) {
  const Encoding encoding = geometry.encoding;
  const FieldReader fields(source, node, warnings);
  PatchDescription patch;
  patch.box = fields.box();
  patch.vertexCount = fields.integer("recordCount", 0);
  patch.draws = readDraws(fields, fields);
  patch.implicitMeshSize = implicitMeshSizeOf(fields, {256, 256});
  patch.gridOrigin = gridOriginOf(fields);
  const PatchStorage storage = rowOf(encoding).storage;
  if (storage == PatchStorage::packed) {
    const std::string url = fields.text("data");
    if (url.empty())
      fields.fail(ErrorKind::malformed, "a patch of compact has no data");
    patch.data = referenceOf(fields, url, encoding);
    return patch;
  }
  readPatchReferences(source, node, encoding, warnings, patch);
  if (patch.coord.empty())
    fields.fail(ErrorKind::malformed, "there are no coordinates");
  std::vector<Reference> attributes;
  for (const std::string& url : fields.strings("attrib"))
    attributes.push_back(referenceOf(fields, url, encoding));
  patch.attributes = referencesByAttribute(fields, attributes, geometry.attributes, encoding);
  return patch;
}

/// Bits of the stored coordinates: the default of `positionBits`.
std::uint32_t storedBits(const FieldReader& fields, const GeometryDescription& geometry) {
  const PatchStorage storage = rowOf(geometry).storage;
  if (storage == PatchStorage::arrays)
    return geometry.coordType == ElementType::float32 ? sourceBits : 8 * byteSizeOf(geometry.coordType);
  if (storage == PatchStorage::packed)
    return packedPositionBits;
  const std::size_t planes = geometry.patches[0].coord.size();
  for (const PatchDescription& patch : geometry.patches)
    if (patch.coord.size() != planes)
      fields.fail(ErrorKind::malformed, "patches differ in their coordinate images");
  return 8 * static_cast<std::uint32_t>(planes);
}

/// Whether coordinates of `stored` bits can hold a lattice of `bits` bits. web/src/document/geometryChecks.ts has the
/// same ranges.
bool holdsLattice(const GeometryDescription& geometry, std::uint32_t bits, std::uint32_t stored) {
  switch (rowOf(geometry).storage) {
  case PatchStorage::packed:
    return bits >= compact::minPositionBits && bits <= compact::maxPositionBits;
  case PatchStorage::bytePlanes:
    return bits >= 8 && bits <= 32 && 8 * coordBytes(geometry.encoding, bits) == stored;
  default:
    return imgeo::holdsLattice(geometry.coordType, bits);
  }
}

Lattice latticeOf(const FieldReader& fields, const GeometryDescription& geometry) {
  const std::uint32_t stored = storedBits(fields, geometry), stated = fields.integer("positionBits", 0);
  const std::uint32_t bits = stated != 0 ? stated : stored;
  const PatchStorage storage = rowOf(geometry).storage;
  if (!holdsLattice(geometry, bits, stored))
    fields.fail(ErrorKind::malformed,
                "positionBits is no precision of coordinates of " + std::to_string(stored / 8) + " bytes");
  const std::optional<DecodeFields> cube =
      storage == PatchStorage::packed && !fields.has("position") && !fields.has("size") ? quantizationCube(fields.box())
                                                                                        : std::nullopt;
  DecodeFields box =
      cube.value_or(DecodeFields{fields.vec3("position", Vec3d{0, 0, 0}), fields.vec3("size", Vec3d{1, 1, 1})});
  if (!(std::min({box.size.x, box.size.y, box.size.z}) >= 0 && std::max({box.size.x, box.size.y, box.size.z}) > 0)) {
    if (storage != PatchStorage::arrays || geometry.coordType != ElementType::float32 || bits != sourceBits)
      fields.fail(ErrorKind::malformed, "size is the extent of no box");
    box.size = {1, 1, 1}; // floats need none: see PatchReader::latticeOf()
  }
  if (geometry.grid == GridKind::heightMap)
    return heightMapLattice(box, heightMapSize(geometry), std::max(stored, 16u));
  return imgeo::latticeOf(box, geometry.encoding, geometry.coordType, bits);
}

/// Refuses element types that indices and normals of arrays cannot have. web/src/document/geometryChecks.ts does the
/// same.
void checkElementTypes(const FieldReader& fields, const GeometryDescription& geometry) {
  const auto any = [&](auto has) { return std::ranges::any_of(geometry.patches, has); };
  if (!isUnsigned(geometry.indexType) && any([](const PatchDescription& patch) { return patch.index.has_value(); }))
    fields.fail(ErrorKind::unsupported,
                fmt::format("indices of type {} are not read; unsigned types are", nameOf(geometry.indexType)));
  if (!any([](const PatchDescription& patch) { return patch.vertexAttributes[VertexRole::normal].has_value(); }))
    return;
  const ElementType type = geometry.attributeTypes[VertexRole::normal];
  if (isPair(geometry.normalEncoding) && type != ElementType::uint8 && type != ElementType::uint16)
    fields.fail(ErrorKind::unsupported,
                fmt::format("normals of two numbers of type {} are not read; Uint8 and Uint16 are", nameOf(type)));
  if (!isPair(geometry.normalEncoding) && isUnsigned(type))
    fields.fail(ErrorKind::unsupported, fmt::format("normals of type {} are not read; signed types are", nameOf(type)));
}

/// Refuses images of which nothing is drawn: unlike arrays, they do not state how many numbers they hold. Packed files
/// are compared with the counts when they are decoded. web/src/document/geometryChecks.ts does the same.
void checkDraws(const FieldReader& fields, const GeometryDescription& geometry) {
  const PatchStorage storage = rowOf(geometry).storage;
  const bool isAll = storage == PatchStorage::packed || geometry.grid;
  for (const PatchDescription& patch : geometry.patches)
    if (!isAll && (storage != PatchStorage::arrays || patch.draws.size() > 1) && drawnCount(patch.draws) == 0)
      fields.fail(ErrorKind::malformed, "vertexCount is 0; nothing is drawn");
}

/// Sets the bits of attributes in images: as a field states, otherwise those of so many images.
void readImageBits(const FieldReader& fields, GeometryDescription& geometry) {
  for (const VertexRole role : vertexRoles) {
    std::optional<std::size_t> count;
    for (const PatchDescription& patch : geometry.patches)
      if (patch.vertexAttributes[role]) {
        if (count.value_or(1 + patch.lowBytes[role].size()) != 1 + patch.lowBytes[role].size())
          fields.fail(ErrorKind::malformed, std::string("patches differ in their images of ") + nameOf(role));
        count = 1 + patch.lowBytes[role].size();
      }
    if (!count)
      continue;
    const char* field = role == VertexRole::normal ? "normalBits" : isTexCoord(role) ? "texCoordBits" : "";
    const std::uint32_t stated = *field == '\0' ? 0 : fields.integer(field, 0);
    const std::uint32_t bits = stated != 0 ? stated : bitsOfImages(role, geometry.normalEncoding, *count);
    if (imageCountOf(role, geometry.normalEncoding, bits) != *count)
      fields.fail(ErrorKind::unsupported, std::to_string(*count) + " images of " + nameOf(role) +
                                              " hold no numbers of " + std::to_string(bits) + " bits");
    geometry.imageBits[role] = bits;
  }
}

/// The encoding that a node's name and its `profile` field state.
Encoding encodingOf(const FieldReader& fields) {
  const std::string profile = fields.text("profile");
  for (const EncodingRow* row : allEncodings()) {
    const GeometryNode& node = row->node;
    if (!equalIgnoringCase(fields.node().name(), node.name))
      continue;
    const bool hasNoProfile = *node.profile == '\0';
    if (profile.empty() && row->storage == PatchStorage::packed && fields.has("data"))
      return row->encoding; // no other encoding has `data`
    const bool isDefault = node.isDefaultProfile && !fields.has("data");
    if (hasNoProfile || (profile.empty() ? isDefault : equalIgnoringCase(profile, node.profile)))
      return row->encoding;
  }
  failChoice(fields, "profile", std::array{"classic", "compact"});
}

/// Refers the normals of all patches to the fourth elements of their coordinates (normalAsSphericalCoordinates).
void takeNormalsFromCoords(const FieldReader& fields, GeometryDescription& geometry) {
  if (byteSizeOf(geometry.coordType) != 2)
    fields.fail(ErrorKind::unsupported,
                fmt::format("spherical normals in coordinates of type {} are not read", nameOf(geometry.coordType)));
  geometry.normalEncoding = NormalEncoding::spherical;
  geometry.attributeTypes[VertexRole::normal] = ElementType::uint8;
  for (PatchDescription& patch : geometry.patches)
    patch.vertexAttributes[VertexRole::normal] = normalInCoords(patch.coord[0]);
}

std::vector<Operator> operatorsOf(const FieldReader& fields, Encoding encoding) {
  const std::string text = fields.text("operators");
  auto [operators, problem] = readOperators(text, rowOf(encoding).storage == PatchStorage::bytePlanes);
  if (!problem.empty())
    fields.warnOrFail(refusalOf(text, problem), "none is applied");
  return operators;
}

} // namespace

bool isGeometryNode(const char* name) {
  return std::ranges::any_of(allEncodings(),
                             [&](const EncodingRow* row) { return equalIgnoringCase(name, row->node.name); });
}

std::vector<Draw> readDraws(const FieldReader& fields, const FieldReader& lenient) {
  const std::vector<std::string> types = primitiveNames(fields);
  std::vector<std::uint32_t> counts = fields.integers("vertexCount");
  if (counts.empty())
    counts = {0}; // X3DOM: all indices
  if (types.size() > counts.size())
    lenient.warnOrFail(fmt::format("primType has {} draws, vertexCount {}", types.size(), counts.size()),
                       "the further ones are not used");
  else if (std::max<std::size_t>(types.size(), 1) < counts.size())
    lenient.warnOrFail(
        fmt::format("primType has {} of {} draws", std::max<std::size_t>(types.size(), 1), counts.size()),
        "TRIANGLES are drawn for the others");
  std::vector<Draw> draws;
  for (std::size_t i = 0; i < counts.size(); ++i)
    draws.push_back({i < types.size() ? primitiveNamed(lenient, types[i]) : Primitive::triangles, counts[i]});
  return draws;
}

bool readSolid(const FieldReader& fields) {
  return fields.boolean("solid", true) &&
         orientationOf(readOperators(fields.text("operators"), true).operators) != Orientation::folded;
}

std::optional<std::string> reasonGeometryIsNotInFiles(const DocumentText& source, const pugi::xml_node& node) {
  if (const auto reason = reasonImagesAreNotInFiles(source, node))
    return reason;
  for (const pugi::xml_node& child : node.children())
    if (equalIgnoringCase(child.name(), "GeometryPatch"))
      if (const auto reason = reasonImagesAreNotInFiles(source, child))
        return reason;
  return {};
}

namespace {

/// The set of texture coordinates of the images of a mesh's levels; 0: they have none.
std::uint32_t chipSetOf(const FieldReader& fields) {
  const std::uint32_t set = fields.integer("chips", 0);
  if (set < maxTexCoordSets)
    return set;
  fields.warnOrFail("chips names no set of texture coordinates", "it counts as absent");
  return 0;
}

} // namespace

GeometryDescription readGeometry(const DocumentText& source, const pugi::xml_node& node, DocumentWarnings* warnings) {
  const FieldReader fields(source, node, warnings);
  GeometryDescription geometry;
  const Encoding encoding = encodingOf(fields);
  if (const auto reason = reasonGeometryIsNotInFiles(source, node); reason && encoding == Encoding::classic)
    fields.fail(ErrorKind::unsupported, *reason);
  geometry.encoding = encoding;
  const EncodingRow& row = rowOf(encoding);
  if (const std::string base = fields.text("base"); row.capabilities.base && !base.empty())
    geometry.base = referenceOf(fields, base, encoding);
  if (const std::string levels = fields.text("levels"); row.capabilities.base && !levels.empty())
    geometry.levels =
        LevelsDescription{levels, topologyOf(readDraws(fields, fields)[0].primitive), {}, chipSetOf(fields)};
  for (const VertexRole role : texCoordRoles)
    geometry.texCoordBoxes[texCoordSetOf(role)] = {fields.vec2(minFieldOf(role).c_str(), {0, 0}),
                                                   fields.vec2(sizeFieldOf(role).c_str(), {1, 1})};
  geometry.texCoordMappings = fields.strings("texCoordMapping");
  geometry.texCoordMappings.resize(std::min(geometry.texCoordMappings.size(), maxTexCoordSets));
  geometry.normalEncoding = choiceOf<NormalEncoding>(fields, "normalEncoding", normalEncodings, NormalEncoding::rgb);
  geometry.indexType = choiceOf<ElementType>(
      fields, "indexType",
      row.storage == PatchStorage::arrays ? std::span<const ElementType>(elementTypes) : imageIndexTypes,
      ElementType::uint16);
  geometry.ccw = fields.boolean("ccw", true);
  if (row.storage == PatchStorage::arrays) {
    const auto typeOf = [&](const char* name) {
      return choiceOf<ElementType>(fields, name, elementTypes, ElementType::float32);
    };
    geometry.coordType = typeOf("coordType");
    for (const VertexRole role : vertexRoles)
      geometry.attributeTypes[role] = typeOf(typeFieldOf(role).c_str());
    geometry.colorComponents = fields.boolean("rgbaColors", false) ? 4 : 3;
    if (fields.boolean("compressed", false))
      fields.fail(ErrorKind::unsupported,
                  "compressed arrays are not read; let the server compress the files (Content-Encoding) instead");
  } else {
    geometry.colorComponents = fields.integer("numColorComponents", 3);
    if (geometry.colorComponents != 3 && geometry.colorComponents != 4)
      fields.fail(ErrorKind::malformed,
                  fmt::format("numColorComponents=\"{}\" is neither 3 nor 4", geometry.colorComponents));
  }
  geometry.operators = operatorsOf(fields, encoding);
  geometry.attributes = readVertexAttributes(source, node, encoding);
  for (const pugi::xml_node& child : node.children())
    if (equalIgnoringCase(child.name(), "GeometryPatch") && !geometry.levels)
      geometry.patches.push_back(readPatch(source, child, geometry, warnings));
  if (geometry.patches.empty() && !geometry.levels)
    geometry.patches.push_back(readPatch(source, node, geometry, warnings));
  if (row.storage == PatchStorage::bytePlanes)
    readImageBits(fields, geometry);
  if (row.storage == PatchStorage::bytePlanes)
    geometry.grid = gridOf(fields);
  if (geometry.grid)
    describeGrids(fields, geometry);
  geometry.isFlat = row.storage == PatchStorage::arrays && !fields.boolean("normalPerVertex", true);
  if (geometry.isFlat)
    for (PatchDescription& patch : geometry.patches)
      patch.vertexAttributes[VertexRole::normal].reset();
  if (!geometry.isFlat && row.storage == PatchStorage::arrays && fields.boolean("normalAsSphericalCoordinates", false))
    takeNormalsFromCoords(fields, geometry);
  if (row.storage == PatchStorage::arrays)
    checkElementTypes(fields, geometry);
  geometry.lattice = latticeOf(fields, geometry);
  checkDraws(fields, geometry);
  return geometry;
}

} // namespace imgeo
