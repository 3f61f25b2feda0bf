#include "documents/geometry_reader.h"

#include "containers/encodings.h"
#include "containers/grid.h"
#include "containers/stored_coords.h"
#include "documents/geometry_element.h"
#include "documents/grid_reader.h"
#include "documents/patch_references.h"
#include "documents/vertex_attribute_reader.h"
#include "markup/find_x3d.h"

#include <algorithm>

namespace imgeo {

namespace {

ElementType elementTypeOf(const FieldReader& fields, const char* name, ElementType fallback) {
  const std::string text = fields.text(name);
  if (text.empty())
    return fallback;
  for (const ElementType type : {ElementType::int8, ElementType::uint8, ElementType::int16, ElementType::uint16,
                                 ElementType::int32, ElementType::uint32, ElementType::float32})
    if (equalIgnoringCase(text, nameOf(type)))
      return type;
  fields.fail(ErrorKind::unsupported, std::string(name) + " is no element type we know");
}

NormalEncoding normalEncodingOf(const FieldReader& fields) {
  const std::string text = fields.text("normalEncoding");
  for (const NormalEncoding encoding : {NormalEncoding::octahedral, NormalEncoding::spherical, NormalEncoding::palette})
    if (equalIgnoringCase(text, nameOf(encoding)))
      return encoding;
  if (!text.empty() && !equalIgnoringCase(text, nameOf(NormalEncoding::rgb)))
    fields.fail(ErrorKind::unsupported, "normalEncoding is none that we know");
  return NormalEncoding::rgb;
}

Primitive primitiveNamed(const FieldReader& fields, const std::string& name) {
  for (const Primitive primitive : {Primitive::points, Primitive::lines, Primitive::lineStrip, Primitive::lineLoop,
                                    Primitive::triangles, Primitive::triangleStrip, Primitive::triangleFan})
    if (equalIgnoringCase(name, nameOf(primitive)))
      return primitive;
  fields.warnOrFail("primType is none of those we read", "TRIANGLES are drawn");
  return Primitive::triangles;
}

PatchDescription readPatch(const DocumentText& source, const pugi::xml_node& node, const GeometryDescription& geometry,
                           Vec2<std::uint32_t> implicitMeshSize, DocumentWarnings* warnings) {
  const Encoding encoding = geometry.encoding;
  const FieldReader fields(source, node);
  PatchDescription patch;
  patch.box = fields.box();
  patch.vertexCount = fields.integer("recordCount", 0);
  patch.draws = readDraws(fields, FieldReader(source, node, warnings));
  patch.implicitMeshSize = implicitMeshSize;
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

Lattice latticeOf(const FieldReader& fields, const GeometryDescription& geometry) {
  const std::uint32_t stored = storedBits(fields, geometry), bits = fields.integer("positionBits", stored);
  const PatchStorage storage = rowOf(geometry).storage;
  const bool canHoldLattice = storage == PatchStorage::arrays ? holdsLattice(geometry.coordType, bits)
                                                              : bits >= 8 && bits <= 32 &&
                                                                    (storage == PatchStorage::packed ||
                                                                     8 * coordBytes(geometry.encoding, bits) == stored);
  if (!canHoldLattice)
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
  fields.fail(ErrorKind::unsupported, "profile is neither classic nor compact");
}

/// Refers the normals of all patches to the fourth elements of their coordinates (normalAsSphericalCoordinates).
void takeNormalsFromCoords(const FieldReader& fields, GeometryDescription& geometry) {
  if (byteSizeOf(geometry.coordType) != 2)
    fields.fail(ErrorKind::unsupported,
                std::string("spherical normals in coordinates of type ") + nameOf(geometry.coordType));
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
  const std::vector<std::string> types = fields.strings("primType");
  std::vector<std::uint32_t> counts = fields.integers("vertexCount");
  if (counts.empty())
    counts = {0}; // X3DOM: all indices
  if (!types.empty() && types.size() != counts.size())
    lenient.warnOrFail("primType and vertexCount differ in their number of draws",
                       types.size() < counts.size() ? "TRIANGLES are drawn for the others"
                                                    : "the further primType are not used");
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

GeometryDescription readGeometry(const DocumentText& source, const pugi::xml_node& node, DocumentWarnings* warnings) {
  const FieldReader fields(source, node);
  GeometryDescription geometry;
  const Encoding encoding = encodingOf(fields);
  if (const auto reason = reasonGeometryIsNotInFiles(source, node); reason && encoding == Encoding::classic)
    fields.fail(ErrorKind::unsupported, *reason);
  geometry.encoding = encoding;
  const EncodingRow& row = rowOf(encoding);
  if (const std::string base = fields.text("base"); row.capabilities.base && !base.empty())
    geometry.base = referenceOf(fields, base, encoding);
  for (const VertexRole role : texCoordRoles)
    geometry.texCoordBoxes[texCoordSetOf(role)] = {fields.vec2(minFieldOf(role).c_str(), {0, 0}),
                                                   fields.vec2(sizeFieldOf(role).c_str(), {1, 1})};
  geometry.texCoordMappings = fields.strings("texCoordMapping");
  geometry.texCoordMappings.resize(std::min(geometry.texCoordMappings.size(), maxTexCoordSets));
  geometry.normalEncoding = normalEncodingOf(fields);
  geometry.indexType = elementTypeOf(fields, "indexType", ElementType::uint16);
  geometry.ccw = fields.boolean("ccw", true);
  if (row.storage == PatchStorage::arrays) {
    geometry.coordType = elementTypeOf(fields, "coordType", ElementType::float32);
    for (const VertexRole role : vertexRoles)
      geometry.attributeTypes[role] = elementTypeOf(fields, typeFieldOf(role).c_str(), ElementType::float32);
    geometry.colorComponents = fields.boolean("rgbaColors", false) ? 4 : 3;
    if (fields.boolean("compressed", false))
      fields.fail(ErrorKind::unsupported, "compressed containers are not read");
  } else {
    geometry.colorComponents = fields.integer("numColorComponents", 3);
    if (geometry.colorComponents != 3 && geometry.colorComponents != 4)
      fields.fail(ErrorKind::malformed, "numColorComponents is neither 3 nor 4");
    if (geometry.indexType != ElementType::uint16 && geometry.indexType != ElementType::uint32)
      fields.fail(ErrorKind::unsupported, "images hold indices of type Uint16 or Uint32");
  }
  geometry.operators = operatorsOf(FieldReader(source, node, warnings), encoding);
  geometry.attributes = readVertexAttributes(source, node, encoding);
  const Vec2<std::uint32_t> implicitMeshSize = implicitMeshSizeOf(fields, {256, 256});
  for (const pugi::xml_node& child : node.children())
    if (equalIgnoringCase(child.name(), "GeometryPatch"))
      geometry.patches.push_back(readPatch(source, child, geometry,
                                           implicitMeshSizeOf(FieldReader(source, child), implicitMeshSize), warnings));
  if (geometry.patches.empty())
    geometry.patches.push_back(readPatch(source, node, geometry, implicitMeshSize, warnings));
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
  geometry.lattice = latticeOf(fields, geometry);
  return geometry;
}

} // namespace imgeo
