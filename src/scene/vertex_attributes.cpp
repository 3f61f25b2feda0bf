#include "scene/vertex_attributes.h"

#include <algorithm>
#include <set>

namespace imgeo {

namespace {

NamedAttribute gather(const NamedAttribute& attribute, std::span<const std::uint32_t> indices) {
  NamedAttribute result{attribute.name, attribute.components, {}};
  result.values.reserve(indices.size() * attribute.components);
  for (const std::uint32_t i : indices)
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      result.values.push_back(attribute.values[std::size_t{i} * attribute.components + c]);
  return result;
}

/// Appends `moreCount` elements to `count` elements; `missing` replaces those of an empty vector.
template <typename T>
void append(std::vector<T>& values, std::size_t count, const std::vector<T>& more, std::size_t moreCount, T missing) {
  if (values.empty() && more.empty())
    return;
  values.resize(count, missing);
  values.insert(values.end(), more.begin(), more.end());
  values.resize(count + moreCount, missing);
}

} // namespace

std::size_t texCoordSetCount(const VertexAttributes& attributes) {
  std::size_t count = 0;
  while (count < maxTexCoordSets && !texCoordsOf(attributes, count).empty())
    ++count;
  return count;
}

std::size_t texCoordSetNamed(const std::string& mapping, const VertexAttributes& attributes) {
  const std::vector<std::string>& names = attributes.texCoordMappings;
  const std::size_t set = static_cast<std::size_t>(std::ranges::find(names, mapping) - names.begin());
  return set < std::min(names.size(), texCoordSetCount(attributes)) ? set : 0;
}

const char* nameOf(VertexRole role) {
  const char* name = "";
  visitAttributeRows([&](const auto& row) { name = row.role == role ? row.name : name; });
  return name;
}

bool hasAttribute(const VertexAttributes& attributes, VertexRole role) {
  bool isPresent = false;
  visitAttributes(attributes,
                  [&](const auto& row, const auto& values) { isPresent |= row.role == role && !values.empty(); });
  return isPresent;
}

bool hasAnyAttribute(const VertexAttributes& attributes) {
  return !attributes.namedAttributes.empty() ||
         std::ranges::any_of(vertexRoles, [&](VertexRole role) { return hasAttribute(attributes, role); });
}

VertexAttributes gather(const VertexAttributes& attributes, std::span<const std::uint32_t> indices) {
  VertexAttributes result;
  visitAttributes(attributes, result,
                  [&](const auto&, const auto& values, auto& gathered) { gathered = gather(values, indices); });
  result.texCoordMappings = attributes.texCoordMappings;
  result.colorComponents = attributes.colorComponents;
  for (const NamedAttribute& attribute : attributes.namedAttributes)
    result.namedAttributes.push_back(gather(attribute, indices));
  return result;
}

void append(VertexAttributes& attributes, std::size_t count, const VertexAttributes& more, std::size_t moreCount) {
  visitAttributes(attributes, more, [&](const auto& row, auto& values, const auto& moreValues) {
    append(values, count, moreValues, moreCount, row.missing);
  });
  if (attributes.texCoordMappings.empty())
    attributes.texCoordMappings = more.texCoordMappings;
  attributes.colorComponents = std::max(attributes.colorComponents, more.colorComponents);
  std::vector<NamedAttribute>& named = attributes.namedAttributes;
  for (const NamedAttribute& attribute : more.namedAttributes)
    if (std::ranges::find(named, attribute.name, &NamedAttribute::name) == named.end())
      named.push_back({attribute.name, attribute.components, {}});
  for (NamedAttribute& attribute : named) {
    const auto other = std::ranges::find(more.namedAttributes, attribute.name, &NamedAttribute::name);
    const std::size_t components = attribute.components;
    const bool isPresent = other != more.namedAttributes.end() && other->components == components;
    append(attribute.values, count * components, isPresent ? other->values : std::vector<float>{},
           moreCount * components, 0.0f);
  }
}

bool isConsistent(const VertexAttributes& attributes, std::size_t count) {
  bool areEmptyOrAll = true;
  visitAttributes(attributes, [&](const auto&, const auto& values) {
    areEmptyOrAll = areEmptyOrAll && (values.empty() || values.size() == count);
  });
  std::set<std::string> names;
  return areEmptyOrAll && std::ranges::all_of(attributes.namedAttributes, [&](const NamedAttribute& attribute) {
           return attribute.components >= 1 && attribute.components <= 4 &&
                  attribute.values.size() == count * attribute.components && names.insert(attribute.name).second;
         });
}

} // namespace imgeo
