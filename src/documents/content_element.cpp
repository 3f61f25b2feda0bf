#include "documents/content_element.h"

#include "documents/animation_element.h"
#include "documents/node_fields_reader.h"
#include "documents/node_fields_writer.h"
#include "documents/skin_element.h"
#include "markup/find_x3d.h"

#include <variant>
#include <vector>

namespace imgeo {

namespace {

Element elementOf(const Group&, const Attributes& names) {
  return {"Group", {names}};
}
Element elementOf(const Transform& transform, const Attributes& names) {
  return nodeElement(transform.isJoint ? "HAnimJoint" : "Transform", transform, names);
}
Element elementOf(const Shape&, const Attributes& names) {
  return {"Shape", {names}};
}
Element elementOf(const Viewpoint& viewpoint, const Attributes& names) {
  return nodeElement("Viewpoint", viewpoint, names);
}
Element elementOf(const OrthoViewpoint& viewpoint, const Attributes& names) {
  Element element = nodeElement("OrthoViewpoint", viewpoint, names);
  element.groups.back().push_back({"fieldOfView", numbers(viewpoint.min) + " " + numbers(viewpoint.max)});
  return element;
}
Element elementOf(const DirectionalLight& light, const Attributes& names) {
  return nodeElement("DirectionalLight", light, names);
}
Element elementOf(const PointLight& light, const Attributes& names) {
  return nodeElement("PointLight", light, names);
}
Element elementOf(const SpotLight& light, const Attributes& names) {
  return nodeElement("SpotLight", light, names);
}
Element elementOf(const TimeSensor& sensor, const Attributes& names) {
  return nodeElement("TimeSensor", sensor, names);
}
Element elementOf(const Interpolator& interpolator, const Attributes& names) {
  return interpolatorElement(interpolator, names);
}
Element elementOf(const Humanoid& humanoid, const Attributes& names) {
  return humanoidElement(humanoid, names);
}
Element elementOf(const Displacer& displacer, const Attributes& names) {
  return nodeElement("HAnimDisplacer", displacer, names);
}
Element elementOf(const GenericNode&, const Attributes&) {
  return {};
}

OrthoViewpoint readOrthoViewpoint(const FieldReader& fields) {
  OrthoViewpoint viewpoint = readNode<OrthoViewpoint>(fields);
  if (const std::vector<double> edges = fields.reals("fieldOfView", 4); !edges.empty()) {
    viewpoint.min = {edges[0], edges[1]};
    viewpoint.max = {edges[2], edges[3]};
  }
  return viewpoint;
}

std::optional<NodeContent> readLight(const FieldReader& fields) {
  if (!fields.boolean("on", true))
    return {};
  if (equalIgnoringCase(fields.node().name(), "DirectionalLight"))
    return readNode<DirectionalLight>(fields);
  if (equalIgnoringCase(fields.node().name(), "PointLight"))
    return readNode<PointLight>(fields);
  return readNode<SpotLight>(fields);
}

} // namespace

Element contentElement(const NodeContent& content, const Attributes& names) {
  return std::visit([&](const auto& node) { return elementOf(node, names); }, content);
}

std::optional<NodeContent> readContent(const FieldReader& fields) {
  const auto is = [&](const char* name) { return equalIgnoringCase(fields.node().name(), name); };
  if (is("Viewpoint"))
    return readNode<Viewpoint>(fields);
  if (is("OrthoViewpoint"))
    return readOrthoViewpoint(fields);
  if (is("TimeSensor"))
    return readNode<TimeSensor>(fields);
  if (const std::optional<InterpolatorKind> kind = interpolatorKindOf(fields.node().name()))
    return readInterpolator(*kind, fields);
  return readLight(fields);
}

} // namespace imgeo
