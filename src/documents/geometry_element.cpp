#include "documents/geometry_element.h"

#include "containers/stored_coords.h"

#include <cassert>

namespace imgeo {

namespace {

std::string url(const Reference& reference, Container container) {
  assert(reference.url.find('#') == std::string::npos);
  if (container == Container::bg && (reference.first != 0 || reference.stride != 0))
    return reference.url + "#" + std::to_string(reference.first) + "+" + std::to_string(reference.stride);
  if (reference.first != 0)
    return reference.url + "#" + std::to_string(reference.first);
  return reference.url;
}

} // namespace

Attributes boxAttributes(const Box3d& box) {
  if (box.empty())
    return {};
  return {{"bboxCenter", numbers(box.center())}, {"bboxSize", numbers(box.size())}};
}

std::string primTypes(const std::vector<Draw>& draws) {
  std::vector<std::string> types;
  for (const Draw& draw : draws)
    types.push_back(nameOf(draw.primitive));
  return strings(types);
}

std::string counts(const std::vector<Draw>& draws) {
  std::string text;
  for (const Draw& draw : draws)
    text.append(text.empty() ? "" : " ").append(std::to_string(draw.count));
  return text;
}

Element patchElement(const PatchDescription& patch, const GeometryDescription& geometry) {
  const Container container = geometry.container;
  Attributes draws{{"recordCount", std::to_string(patch.vertexCount)},
                   {"primType", primTypes(patch.draws)},
                   {"vertexCount", counts(patch.draws)}};
  if (patch.data)
    return {"GeometryPatch", {boxAttributes(patch.box), draws, {{"data", url(*patch.data, container)}}}};
  if (container == Container::sig)
    draws.push_back({"implicitMeshSize", std::to_string(patch.implicitMeshSize.x) + " " +
                                             std::to_string(patch.implicitMeshSize.y)});
  Attributes references;
  const auto add = [&](const char* name, const std::optional<Reference>& reference) {
    if (reference)
      references.push_back({name, url(*reference, container)});
  };
  add("index", patch.index);
  if (container == Container::sig) {
    std::vector<std::string> planes;
    for (const Reference& plane : patch.coord)
      planes.push_back(url(plane, container));
    references.push_back({"coord", strings(planes)});
  } else if (!patch.coord.empty()) {
    references.push_back({"coord", url(patch.coord[0], container)});
  }
  if (!hasNormalsInCoords(geometry))
    add("normal", patch.normal);
  add("texCoord", patch.texCoord);
  add("color", patch.color);
  std::vector<std::string> attributes;
  for (const std::vector<Reference>& planes : patch.attributes)
    for (const Reference& plane : planes)
      attributes.push_back(url(plane, container));
  if (!attributes.empty())
    references.push_back({"attrib", strings(attributes)});
  return {"GeometryPatch", {boxAttributes(patch.box), draws, references}};
}

const char* geometryNodeName(Container container) {
  return container == Container::sig ? "ImageGeometry" : "BinaryGeometry";
}

Element geometryElement(const GeometryDescription& geometry, bool solid, const Attributes& names) {
  const DecodeFields decode = decodeFields(geometry);
  Attributes box{{"position", numbers(decode.position)}, {"size", numbers(decode.size)}};
  if (geometry.container == Container::sig || geometry.coordType != ElementType::float32 ||
      geometry.lattice.bits != sourceBits)
    box.push_back({"positionBits", std::to_string(geometry.lattice.bits)});
  addUnless(box, "solid", solid, true, "false");
  Attributes stored;
  if (geometry.profile == Profile::compact)
    stored = {{"profile", nameOf(geometry.profile)}};
  else if (geometry.container == Container::bg)
    stored = {{"indexType", nameOf(geometry.indexType)},
              {"coordType", nameOf(geometry.coordType)},
              {"normalType", nameOf(geometry.normalType)},
              {"texCoordType", nameOf(geometry.texCoordType)},
              {"colorType", nameOf(geometry.colorType)}};
  else if (geometry.indexType != ElementType::uint16)
    stored = {{"indexType", nameOf(geometry.indexType)}};
  if (geometry.base)
    stored.push_back({"base", url(*geometry.base, geometry.container)});
  if (hasNormalsInCoords(geometry))
    stored.push_back({"normalAsSphericalCoordinates", "true"});
  else if (geometry.normalEncoding != NormalEncoding::rgb)
    stored.push_back({"normalEncoding", nameOf(geometry.normalEncoding)});
  addUnless(stored, "texCoordMin", geometry.texCoordMin, Vec2f{0, 0}, numbers(geometry.texCoordMin));
  addUnless(stored, "texCoordSize", geometry.texCoordSize, Vec2f{1, 1}, numbers(geometry.texCoordSize));
  if (geometry.colorComponents == 4)
    stored.push_back(geometry.container == Container::bg ? Attribute{"rgbaColors", "true"}
                                                         : Attribute{"numColorComponents", "4"});
  return {geometryNodeName(geometry.container), {names, box, stored}};
}

Element attributeElement(const AttributeDescription& attribute, Container container) {
  Attributes fields{{"name", attribute.name}, {"numComponents", std::to_string(attribute.components)}};
  if (container == Container::sig)
    fields.push_back({"valueBits", std::to_string(8 * attribute.bytes)});
  fields.push_back({"valueMin", numbers(attribute.min)});
  fields.push_back({"valueSize", numbers(attribute.size)});
  return {"FloatVertexAttribute", {fields}};
}

} // namespace imgeo
