#include "documents/geometry_element.h"

#include "base/shortest_decimal.h"
#include "containers/encodings.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

/// A location as the fragment of a url; empty for the beginning of a file.
std::string fragmentOf(const TexelLocation& location) {
  return location.firstTexel == 0 ? "" : "#" + std::to_string(location.firstTexel);
}
std::string fragmentOf(const PatchLocation& location) {
  return location.patchIndex == 0 ? "" : "#" + std::to_string(location.patchIndex);
}
std::string fragmentOf(const ByteLocation& location) {
  if (location == ByteLocation{})
    return "";
  return "#" + std::to_string(location.byteOffset) + "+" + std::to_string(location.byteStride);
}

std::string urlOf(const Reference& reference) {
  assert(reference.url.find('#') == std::string::npos);
  return reference.url + std::visit([](const auto& location) { return fragmentOf(location); }, reference.location);
}

/// The images of an attribute as an MFString, in quotes only where they are needed.
std::string imageUrls(const Reference& first, const std::vector<Reference>& lowBytes) {
  std::vector<std::string> urls{urlOf(first)};
  for (const Reference& image : lowBytes)
    urls.push_back(urlOf(image));
  return urls.size() == 1 && urls[0].find('"') == std::string::npos ? urls[0] : quoteStrings(urls);
}

/// The components of a vector as the shortest decimals whose error is at most `fraction` of the lattice's step along
/// their axis.
std::string shortNumbers(Vec3d vector, const Lattice& lattice, double fraction) {
  for (int axis = 0; axis < 3; ++axis) {
    const double stretch = lattice.stretch[axis] > 0 ? lattice.stretch[axis] : 1;
    vector[axis] = shortestWithin(vector[axis], fraction * stretch * lattice.step);
  }
  return numbers(vector);
}

} // namespace

Attributes boxAttributes(const Box3d& box, const Lattice& lattice) {
  if (box.empty())
    return {};
  return {{"bboxCenter", shortNumbers(box.center(), lattice, 0.25)},
          {"bboxSize", shortNumbers(box.size(), lattice, 0.25)}};
}

std::string primTypes(const std::vector<Draw>& draws) {
  std::vector<std::string> types;
  types.reserve(draws.size());
  for (const Draw& draw : draws)
    types.push_back(nameOf(draw.primitive));
  return quoteStrings(types);
}

std::string vertexCounts(const std::vector<Draw>& draws) {
  std::string text;
  for (const Draw& draw : draws)
    text.append(text.empty() ? "" : " ").append(std::to_string(draw.count));
  return text;
}

namespace {

bool isInAnyPatch(const GeometryDescription& geometry, VertexRole role) {
  return std::ranges::any_of(geometry.patches,
                             [&](const PatchDescription& patch) { return patch.vertexAttributes[role].has_value(); });
}

/// Adds the bits of an attribute's numbers, unless they follow from the number of its images.
void addBits(Attributes& fields, const char* name, const GeometryDescription& geometry, VertexRole role) {
  const std::uint32_t bits = geometry.imageBits[role];
  const std::size_t imageCount = imageCountOf(role, geometry.normalEncoding, bits);
  if (isInAnyPatch(geometry, role) && bits != bitsOfImages(role, geometry.normalEncoding, imageCount))
    fields.push_back({name, std::to_string(bits)});
}

/// The fields of a compact patch, without its box.
Attributes compactFields(const PatchDescription& patch) {
  Attributes fields{{"recordCount", std::to_string(patch.vertexCount)}};
  if (patch.draws != std::vector<Draw>{{Primitive::triangles, patch.draws.empty() ? 0 : patch.draws[0].count}})
    fields.push_back({"primType", primTypes(patch.draws)});
  fields.push_back({"vertexCount", vertexCounts(patch.draws)});
  fields.push_back({"data", urlOf(*patch.data)});
  return fields;
}

} // namespace

std::string typeFieldOf(VertexRole role) {
  return std::string(nameOf(role)) + "Type";
}

std::string minFieldOf(VertexRole role) {
  return std::string(nameOf(role)) + "Min";
}

std::string sizeFieldOf(VertexRole role) {
  return std::string(nameOf(role)) + "Size";
}

bool isSinglePatch(const GeometryDescription& geometry) {
  return !geometry.levels && geometry.patches.size() == 1 && geometry.patches[0].data &&
         geometry.patches[0].box == geometry.box;
}

Element patchElement(const PatchDescription& patch, const GeometryDescription& geometry) {
  const Encoding encoding = geometry.encoding;
  const bool hasPlanes = rowOf(encoding).storage == PatchStorage::bytePlanes;
  Attributes draws{{"recordCount", std::to_string(patch.vertexCount)},
                   {"primType", primTypes(patch.draws)},
                   {"vertexCount", vertexCounts(patch.draws)}};
  if (patch.data)
    return {"GeometryPatch", {boxAttributes(patch.box, geometry.lattice), compactFields(patch)}};
  if (hasPlanes)
    draws.push_back({"implicitMeshSize",
                     std::to_string(patch.implicitMeshSize.x) + " " + std::to_string(patch.implicitMeshSize.y)});
  if (geometry.grid)
    draws.erase(draws.begin(), draws.end() - 1); // they follow from the size
  if (patch.gridOrigin != Vec2<std::uint32_t>{})
    draws.push_back({"gridOrigin", std::to_string(patch.gridOrigin.x) + " " + std::to_string(patch.gridOrigin.y)});
  Attributes references;
  const auto add = [&](const char* name, const std::optional<Reference>& reference) {
    if (reference)
      references.push_back({name, urlOf(*reference)});
  };
  add("index", patch.index);
  if (hasPlanes) {
    std::vector<std::string> planes;
    for (const Reference& plane : patch.coord)
      planes.push_back(urlOf(plane));
    references.push_back({"coord", quoteStrings(planes)});
  } else if (!patch.coord.empty()) {
    references.push_back({"coord", urlOf(patch.coord[0])});
  }
  for (const VertexRole role : vertexRoles)
    if (patch.vertexAttributes[role] && (role != VertexRole::normal || !hasNormalsInCoords(geometry)))
      references.push_back({nameOf(role), imageUrls(*patch.vertexAttributes[role], patch.lowBytes[role])});
  std::vector<std::string> attributes;
  for (const std::vector<Reference>& planes : patch.attributes)
    for (const Reference& plane : planes)
      attributes.push_back(urlOf(plane));
  if (!attributes.empty())
    references.push_back({"attrib", quoteStrings(attributes)});
  return {"GeometryPatch", {boxAttributes(patch.box, geometry.lattice), draws, references}};
}

namespace {

/// How far numbers that determine a lattice may be rounded, in its steps: this removes digits that are rounding errors.
constexpr double latticeTolerance = 1e-7;

} // namespace

Attributes decodeAttributes(const GeometryDescription& geometry) {
  const DecodeFields decode = decodeFields(geometry);
  return {{"position", shortNumbers(decode.position, geometry.lattice, latticeTolerance)},
          {"size", shortNumbers(decode.size, geometry.lattice, latticeTolerance)}};
}

Lattice latticeInDocuments(const GeometryDescription& geometry) {
  DecodeFields fields = decodeFields(geometry);
  for (int axis = 0; axis < 3; ++axis) {
    fields.position[axis] = shortestWithin(fields.position[axis], latticeTolerance * geometry.lattice.step);
    fields.size[axis] = shortestWithin(fields.size[axis], latticeTolerance * geometry.lattice.step);
  }
  return latticeOf(fields, geometry.encoding, geometry.coordType, geometry.lattice.bits);
}

std::optional<Attributes> boxWithLattice(const GeometryDescription& geometry) {
  if (rowOf(geometry).storage != PatchStorage::packed || !isSinglePatch(geometry) || geometry.box.empty())
    return {};
  const Lattice& lattice = geometry.lattice;
  const double longest = geometry.box.longestEdge();
  Vec3d size = geometry.box.size(), center;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = shortestWithin(size[axis], (size[axis] == longest ? latticeTolerance : 0.25) * lattice.step);
    center[axis] = shortestWithin(lattice.origin[axis] + size[axis] / 2, latticeTolerance * lattice.step);
  }
  const std::optional<DecodeFields> derived = quantizationCube({center - size * 0.5, center + size * 0.5});
  const DecodeFields stated = decodeFields(geometry);
  const auto areEqual = [&](const Vec3d& a, const Vec3d& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}) <=
           4 * latticeTolerance * lattice.step;
  };
  if (!derived || !areEqual(derived->position, stated.position) || !areEqual(derived->size, stated.size))
    return {};
  return Attributes{{"bboxCenter", numbers(center)}, {"bboxSize", numbers(size)}};
}

Element geometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names,
                        const std::optional<Attributes>& ownBox) {
  const EncodingRow& row = rowOf(geometry);
  const bool hasElementTypes = row.storage == PatchStorage::arrays;
  Attributes box = ownBox ? *ownBox : decodeAttributes(geometry);
  const bool hasDefaultBits = row.storage == PatchStorage::packed && geometry.lattice.bits == packedPositionBits;
  if (!hasDefaultBits &&
      (!hasElementTypes || geometry.coordType != ElementType::float32 || geometry.lattice.bits != sourceBits))
    box.push_back({"positionBits", std::to_string(geometry.lattice.bits)});
  addUnless(box, "solid", solid, true, "false");
  addUnless(box, "ccw", geometry.ccw, true, "false");
  Attributes fields;
  if (!row.node.isDefaultProfile && !ownBox)
    fields = {{"profile", row.node.profile}};
  if (geometry.grid)
    fields.push_back({"implicitMeshMode", nameOf(*geometry.grid)});
  if (geometry.surfaceDistance) {
    const auto& [largest, mean] = *geometry.surfaceDistance;
    fields.push_back({"surfaceDistance", numbers(std::vector{shortestWithin(largest, 1e-6 * largest),
                                                             shortestWithin(mean, 1e-6 * mean)})});
  }
  if (hasElementTypes) {
    fields = {{"indexType", nameOf(geometry.indexType)}, {"coordType", nameOf(geometry.coordType)}};
    for (const VertexRole role : vertexRoles)
      if (!isTexCoord(role) || texCoordSetOf(role) == 0 || isInAnyPatch(geometry, role))
        fields.push_back({typeFieldOf(role), nameOf(geometry.attributeTypes[role])});
  } else if (row.storage == PatchStorage::bytePlanes && geometry.indexType != ElementType::uint16) {
    fields.push_back({"indexType", nameOf(geometry.indexType)});
  }
  if (geometry.base)
    fields.push_back({"base", urlOf(*geometry.base)});
  if (geometry.levels)
    fields.push_back({"levels", geometry.levels->url});
  if (geometry.levels && geometry.levels->topology == Topology::points)
    fields.push_back({"primType", nameOf(Primitive::points)});
  if (geometry.levels && geometry.levels->chipSet > 0)
    fields.push_back({"chips", std::to_string(geometry.levels->chipSet)});
  if (hasNormalsInCoords(geometry))
    fields.push_back({"normalAsSphericalCoordinates", "true"});
  else if (geometry.normalEncoding != NormalEncoding::rgb)
    fields.push_back({"normalEncoding", nameOf(geometry.normalEncoding)});
  if (row.storage == PatchStorage::bytePlanes) {
    addBits(fields, "normalBits", geometry, VertexRole::normal);
    const auto* set =
        std::ranges::find_if(texCoordRoles, [&](VertexRole role) { return isInAnyPatch(geometry, role); });
    if (set != texCoordRoles.end()) // all sets have the same bits
      addBits(fields, "texCoordBits", geometry, *set);
  }
  for (const VertexRole role : texCoordRoles) {
    const auto& [min, size] = geometry.texCoordBoxes[texCoordSetOf(role)];
    addUnless(fields, minFieldOf(role).c_str(), min, Vec2f{0, 0}, numbers(min));
    addUnless(fields, sizeFieldOf(role).c_str(), size, Vec2f{1, 1}, numbers(size));
  }
  if (!geometry.texCoordMappings.empty())
    fields.push_back({"texCoordMapping", quoteStrings(geometry.texCoordMappings)});
  if (geometry.colorComponents == 4)
    fields.push_back(hasElementTypes ? Attribute{"rgbaColors", "true"} : Attribute{"numColorComponents", "4"});
  Element element{row.node.name, {names, box, fields}};
  if (!isSinglePatch(geometry))
    return element;
  // On one line: indentation would be a tenth of the text of a small shape.
  Attributes oneLine;
  for (Attributes& group : element.groups)
    std::ranges::move(group, std::back_inserter(oneLine));
  std::ranges::move(compactFields(geometry.patches[0]), std::back_inserter(oneLine));
  return {element.name, {std::move(oneLine)}};
}

Element sharedGeometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names) {
  GeometryDescription first = geometry;
  first.patches[0].data->location = PatchLocation{};
  Element element = geometryElement(first, solid, names, {});
  std::ranges::move(boxAttributes(first.box, first.lattice), std::back_inserter(element.groups.back()));
  return element;
}

std::string patchReference(const GeometryDescription& geometry, const std::string& name) {
  return name + "#" + std::to_string(std::get<PatchLocation>(geometry.patches[0].data->location).patchIndex);
}

Element vertexAttributeElement(const AttributeDescription& attribute, Encoding encoding) {
  Attributes fields{{"name", attribute.name}, {"numComponents", std::to_string(attribute.components)}};
  if (!hasElementTypes(encoding))
    fields.push_back({"valueBits", std::to_string(8 * attribute.bytes)});
  fields.push_back({"valueMin", numbers(attribute.min)});
  fields.push_back({"valueSize", numbers(attribute.size)});
  return {"FloatVertexAttribute", {fields}};
}

} // namespace imgeo
