#include "containers/named_attributes.h"

#include "base/error.h"
#include "containers/encodings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace imgeo {

namespace {

double maximumOf(std::uint32_t bytes) {
  return std::ldexp(1.0, static_cast<int>(8 * bytes)) - 1;
}

/// The values of one component over all patches.
struct Values {
  double min = std::numeric_limits<double>::infinity(), max = -min;
  bool areWhole = true;

  void add(float value) {
    min = std::min(min, double{value});
    max = std::max(max, double{value});
    areWhole = areWhole && value == std::floor(value);
  }
};

/// The smallest number of bytes that holds every whole number of the range; 1 if all values are equal; otherwise
/// `maxBytes` if no smaller number is enough or the values are not whole.
std::uint32_t bytesFor(const Values& values, std::uint32_t maxBytes) {
  if (values.max == values.min)
    return 1;
  for (std::uint32_t bytes = 1; values.areWhole && bytes < maxBytes; ++bytes)
    if (values.max - values.min <= maximumOf(bytes))
      return bytes;
  return maxBytes;
}

AttributeDescription describe(const PatchedMesh& mesh, std::size_t attributeIndex, Encoding encoding,
                              std::uint32_t bytes) {
  const NamedAttribute& first = mesh.patches.front().namedAttributes[attributeIndex];
  std::vector<Values> values(first.components);
  for (const Patch& patch : mesh.patches) {
    const NamedAttribute& attribute = patch.namedAttributes.at(attributeIndex);
    for (std::size_t i = 0; i < attribute.values.size(); ++i)
      values[i % first.components].add(attribute.values[i]);
  }

  AttributeDescription description{first.name, first.components, 1, {}, {}};
  for (const Values& component : values)
    description.bytes = std::max(description.bytes, bytesFor(component, bytes));
  for (const Values& component : values) {
    const double extent = component.max - component.min, whole = maximumOf(description.bytes);
    const bool isExact = !hasElementTypes(encoding) && component.areWhole && extent <= whole;
    description.min.push_back(component.min);
    description.size.push_back(isExact ? whole : extent);
  }
  return description;
}

} // namespace

std::vector<AttributeDescription> describeAttributes(const PatchedMesh& mesh, Encoding encoding, std::uint32_t bytes) {
  std::vector<AttributeDescription> descriptions;
  if (mesh.patches.empty())
    return descriptions;
  for (std::size_t i = 0; i < mesh.patches.front().namedAttributes.size(); ++i)
    descriptions.push_back(describe(mesh, i, encoding, bytes));
  return descriptions;
}

std::uint32_t storeNumber(float value, const AttributeDescription& attribute, std::uint32_t component) {
  const double size = attribute.size[component];
  if (!(size > 0))
    return 0;
  const double fraction = (double{value} - attribute.min[component]) / size;
  return static_cast<std::uint32_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * maximumOf(attribute.bytes)));
}

float loadNumber(std::uint32_t stored, const AttributeDescription& attribute, std::uint32_t component) {
  return static_cast<float>(attribute.min[component] + attribute.size[component] * stored / maximumOf(attribute.bytes));
}

double numberErrorBound(Encoding encoding, const AttributeDescription& attribute, std::uint32_t component) {
  if (hasElementTypes(encoding))
    return 0;
  const double low = attribute.min[component], size = attribute.size[component];
  const double rounding = std::max(std::abs(low), std::abs(low + size)) * std::numeric_limits<float>::epsilon();
  return size / maximumOf(attribute.bytes) / 2 + rounding;
}

void checkAttributes(const PatchDescription& patch, const GeometryDescription& geometry) {
  const std::size_t count = geometry.attributes.size();
  bool fits = patch.attributes.size() == count;
  for (std::size_t a = 0; fits && a < count; ++a)
    fits = patch.attributes[a].size() == fileCountOf(geometry.encoding, geometry.attributes[a]);
  if (!fits)
    throw Error(ErrorKind::malformed, "", "a patch has not as many files of attributes as its geometry needs");
}

std::size_t fileCountOf(Encoding encoding, const AttributeDescription& attribute) {
  return hasElementTypes(encoding) ? 1 : attribute.bytes;
}

std::uint32_t channelsOf(const AttributeDescription& attribute) {
  return attribute.components == 2 ? 3 : attribute.components;
}

} // namespace imgeo
