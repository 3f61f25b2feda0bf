#include "import/ply/vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace imgeo {

namespace {

constexpr std::array<std::pair<const char*, PlySemantic>, 22> vertexProperties{
    {{"x", PlySemantic::x},         {"y", PlySemantic::y},
     {"z", PlySemantic::z},         {"nx", PlySemantic::nx},
     {"ny", PlySemantic::ny},       {"nz", PlySemantic::nz},
     {"u", PlySemantic::u},         {"v", PlySemantic::v},
     {"s", PlySemantic::u},         {"t", PlySemantic::v},
     {"texture_u", PlySemantic::u}, {"texture_v", PlySemantic::v},
     {"texture_s", PlySemantic::u}, {"texture_t", PlySemantic::v},
     {"red", PlySemantic::red},     {"diffuse_red", PlySemantic::red},
     {"green", PlySemantic::green}, {"diffuse_green", PlySemantic::green},
     {"blue", PlySemantic::blue},   {"diffuse_blue", PlySemantic::blue},
     {"alpha", PlySemantic::alpha}, {"diffuse_alpha", PlySemantic::alpha}}};

constexpr std::size_t indexOf(PlySemantic semantic) {
  return static_cast<std::size_t>(semantic);
}

PlySemantic semanticOf(const PlyProperty& property) {
  if (!property.isList())
    for (const auto& [name, semantic] : vertexProperties)
      if (property.name == name)
        return semantic;
  return PlySemantic::unknown;
}

/// "scale" for "scale_1" and component 1; empty for a name that does not end in "_1".
std::string baseOfComponent(const std::string& name, std::size_t component) {
  const std::string ending = fmt::format("_{}", component);
  return name.size() > ending.size() && name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : "";
}

/// Whether a name can stand in documents and in comma-separated lists.
bool isPlain(const std::string& name) {
  return std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~' && c != ','; });
}

} // namespace

PlyVertexReader::PlyVertexReader(const PlyElement& element, const AttributeChoice& kept, PlyContent& content)
    : element_(element), content_(content) {
  for (const PlyProperty& property : element.properties) {
    PlySemantic semantic = semanticOf(property);
    if (present_[indexOf(semantic)])
      semantic = PlySemantic::unknown; // a second property of the same meaning, as u beside s
    semantics_.push_back(semantic);
    if (semantic != PlySemantic::unknown) {
      present_[indexOf(semantic)] = true;
      types_[indexOf(semantic)] = property.type;
    }
  }
  chooseNamed(kept);
  for (std::size_t p = 0; p < semantics_.size(); ++p)
    if (semantics_[p] == PlySemantic::unknown && (named_.empty() || named_[p] == nullptr))
      content.noteIgnored(element, element.properties[p]);
  hasNormal_ = has(PlySemantic::nx, PlySemantic::nz);
  hasTexCoord_ = has(PlySemantic::u, PlySemantic::v);
  hasColor_ = has(PlySemantic::red, PlySemantic::blue);
  hasAlpha_ = has(PlySemantic::alpha, PlySemantic::alpha);
  isDouble_ = std::ranges::any_of(std::span(types_).first(3), [](PlyType type) { return type == PlyType::float64; });
}

void PlyVertexReader::chooseNamed(const AttributeChoice& kept) {
  const std::vector<PlyProperty>& properties = element_.properties;
  const auto isFree = [&](std::size_t p) {
    return semantics_[p] == PlySemantic::unknown && !properties[p].isList() && isPlain(properties[p].name);
  };
  std::vector<NamedAttribute>& attributes = content_.attributes.namedAttributes;
  std::vector<std::size_t> attributeOf(properties.size(), properties.size());
  for (std::size_t p = 0, count = 1; p < properties.size(); p += count) {
    count = 1;
    if (!isFree(p))
      continue;
    const std::string base = baseOfComponent(properties[p].name, 0);
    while (!base.empty() && p + count < properties.size() && isFree(p + count) &&
           baseOfComponent(properties[p + count].name, count) == base)
      ++count;
    const bool isGroup = count >= 2 && count <= 4;
    if (!isGroup)
      count = 1;
    const std::string& name = isGroup ? base : properties[p].name;
    if (std::ranges::find(content_.namedAttributes, name) != content_.namedAttributes.end())
      continue;
    content_.namedAttributes.push_back(name);
    if (!kept.has(name))
      continue;
    std::fill_n(attributeOf.begin() + static_cast<std::ptrdiff_t>(p), count, attributes.size());
    attributes.push_back({name, static_cast<std::uint32_t>(count), {}});
  }
  if (attributes.empty())
    return;
  for (const std::size_t attribute : attributeOf)
    named_.push_back(attribute < attributes.size() ? &attributes[attribute] : nullptr);
}

std::vector<PlyVertexReader::Run> PlyVertexReader::runsOfProperties() const {
  std::vector<Run> runs;
  for (std::size_t p = 0; p < element_.properties.size(); ++p) {
    const PlyProperty& property = element_.properties[p];
    if (!runs.empty() && !runs.back().isList && !property.isList() && runs.back().type == property.type)
      ++runs.back().count;
    else
      runs.push_back({p, 1, property.type, property.isList()});
  }
  return runs;
}

bool PlyVertexReader::has(PlySemantic first, PlySemantic last) const {
  return std::all_of(&present_[indexOf(first)], &present_[indexOf(last)] + 1, [](bool there) { return there; });
}

bool PlyVertexReader::isFinite(PlySemantic first, PlySemantic last) const {
  return std::all_of(&values_[indexOf(first)], &values_[indexOf(last)] + 1,
                     [](double value) { return std::isfinite(static_cast<float>(value)); });
}

void PlyVertexReader::reserve() {
  const std::size_t count = element_.count;
  content_.positions.reserve(count);
  VertexAttributes& attributes = content_.attributes;
  attributes.normals.reserve(hasNormal_ ? count : 0);
  attributes.texCoords.reserve(hasTexCoord_ ? count : 0);
  attributes.colors.reserve(hasColor_ ? count : 0);
  for (NamedAttribute& attribute : attributes.namedAttributes)
    attribute.values.reserve(count * attribute.components);
}

/// Colour channels of 16 bits range over 0 .. 65,535, floating-point ones over 0 .. 1, all others over 0 .. 255.
float PlyVertexReader::channel(PlySemantic semantic) {
  const PlyType type = types_[indexOf(semantic)];
  const double maximum = type == PlyType::uint16 ? 65535 : isInteger(type) ? 255 : 1;
  const double fraction = value(semantic) / maximum;
  if (!(fraction >= 0 && fraction * 255 < 255.5)) // beyond rounding
    ++content_.colorsClamped;
  return channelOf(fraction);
}

void PlyVertexReader::noteRounding() {
  for (const PlySemantic semantic : {PlySemantic::x, PlySemantic::y, PlySemantic::z}) {
    const double rounded = static_cast<float>(value(semantic));
    content_.maxRounding = std::max(content_.maxRounding, std::abs(value(semantic) - rounded));
  }
}

const char* PlyVertexReader::addVertex() {
  const auto f = [&](PlySemantic semantic) { return static_cast<float>(value(semantic)); };
  for (int axis = 0; axis < 3; ++axis)
    values_[static_cast<std::size_t>(axis)] -= content_.origin[axis]; // x, y, z are the first semantics
  if (!isFinite(PlySemantic::x, PlySemantic::z))
    return "a coordinate is not a number or beyond single precision";
  content_.positions.push_back({f(PlySemantic::x), f(PlySemantic::y), f(PlySemantic::z)});
  if (isDouble_)
    noteRounding();
  if (hasNormal_)
    content_.attributes.normals.push_back({f(PlySemantic::nx), f(PlySemantic::ny), f(PlySemantic::nz)});
  if (hasTexCoord_) {
    if (!isFinite(PlySemantic::u, PlySemantic::v))
      return "a texture coordinate is not a number";
    content_.attributes.texCoords.push_back({f(PlySemantic::u), f(PlySemantic::v)});
  }
  if (hasColor_) {
    const float red = channel(PlySemantic::red), green = channel(PlySemantic::green), blue = channel(PlySemantic::blue),
                alpha = hasAlpha_ ? channel(PlySemantic::alpha) : 1;
    content_.attributes.colors.emplace_back(red, green, blue, alpha);
    if (alpha < 1)
      content_.attributes.colorComponents = 4;
  }
  if (!namedAreFinite())
    return "an attribute that is to be kept is not a number or beyond single precision";
  return nullptr;
}

bool PlyVertexReader::namedAreFinite() const {
  return std::ranges::all_of(content_.attributes.namedAttributes, [](const NamedAttribute& attribute) {
    return std::all_of(attribute.values.end() - attribute.components, attribute.values.end(),
                       [](float value) { return std::isfinite(value); });
  });
}

} // namespace imgeo
