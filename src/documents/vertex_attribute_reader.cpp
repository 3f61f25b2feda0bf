#include "documents/vertex_attribute_reader.h"

#include "containers/encodings.h"
#include "containers/named_attributes.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace imgeo {

namespace {

AttributeDescription readAttribute(const FieldReader& fields, Encoding encoding) {
  AttributeDescription attribute;
  attribute.name = fields.text("name");
  if (attribute.name.empty())
    fields.fail(ErrorKind::malformed, "an attribute has no name");
  attribute.components = fields.integer("numComponents", 4);
  if (attribute.components < 1 || attribute.components > 4)
    fields.fail(ErrorKind::malformed, "numComponents is none of 1 to 4");
  const std::uint32_t bits = fields.integer("valueBits", 16);
  if (!hasElementTypes(encoding) && bits != 8 && bits != 16 && bits != 24)
    fields.fail(ErrorKind::malformed, "valueBits is none of 8, 16 and 24");
  attribute.bytes = hasElementTypes(encoding) ? 2 : bits / 8;
  const auto perComponent = [&](const char* name, double fallback) {
    std::vector<double> values = fields.reals(name);
    return values.empty() ? std::vector<double>(attribute.components, fallback) : values;
  };
  attribute.min = perComponent("valueMin", 0);
  attribute.size = perComponent("valueSize", 1);
  bool isRange = attribute.min.size() == attribute.components && attribute.size.size() == attribute.components;
  for (std::uint32_t c = 0; isRange && c < attribute.components; ++c)
    isRange =
        attribute.size[c] >= 0 && std::abs(attribute.min[c]) + attribute.size[c] <= std::numeric_limits<float>::max();
  if (!isRange)
    fields.fail(ErrorKind::malformed, "valueMin and valueSize are no range of numbers");
  return attribute;
}

} // namespace

std::vector<AttributeDescription> readVertexAttributes(const DocumentText& source, const pugi::xml_node& node,
                                                       Encoding encoding) {
  std::vector<AttributeDescription> attributes;
  for (const pugi::xml_node& child : node.children()) {
    if (!equalIgnoringCase(child.name(), "FloatVertexAttribute"))
      continue;
    const FieldReader fields(source, child);
    AttributeDescription attribute = readAttribute(fields, encoding);
    if (std::ranges::find(attributes, attribute.name, &AttributeDescription::name) != attributes.end())
      fields.fail(ErrorKind::malformed, "a geometry has two attributes of one name");
    attributes.push_back(std::move(attribute));
  }
  return attributes;
}

std::vector<std::vector<Reference>> referencesByAttribute(const FieldReader& fields,
                                                          const std::vector<Reference>& references,
                                                          const std::vector<AttributeDescription>& attributes,
                                                          Encoding encoding) {
  std::vector<std::vector<Reference>> grouped;
  std::size_t usedCount = 0;
  for (const AttributeDescription& attribute : attributes) {
    const std::size_t count = std::min(fileCountOf(encoding, attribute), references.size() - usedCount);
    const auto first = references.begin() + static_cast<std::ptrdiff_t>(usedCount);
    grouped.emplace_back(first, first + static_cast<std::ptrdiff_t>(count));
    usedCount += count;
    if (count != fileCountOf(encoding, attribute))
      fields.fail(ErrorKind::malformed, "attrib names fewer files than the attributes need");
  }
  if (usedCount != references.size())
    fields.fail(ErrorKind::malformed, "attrib names more files than the attributes need");
  return grouped;
}

} // namespace imgeo
