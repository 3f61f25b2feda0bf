#include "import/ply/vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace imgeo {

namespace {

constexpr std::array<std::pair<const char*, PlySlot>, 22> vertexProperties{
    {{"x", PlySlot::x},         {"y", PlySlot::y},
     {"z", PlySlot::z},         {"nx", PlySlot::nx},
     {"ny", PlySlot::ny},       {"nz", PlySlot::nz},
     {"u", PlySlot::u},         {"v", PlySlot::v},
     {"s", PlySlot::u},         {"t", PlySlot::v},
     {"texture_u", PlySlot::u}, {"texture_v", PlySlot::v},
     {"texture_s", PlySlot::u}, {"texture_t", PlySlot::v},
     {"red", PlySlot::red},     {"diffuse_red", PlySlot::red},
     {"green", PlySlot::green}, {"diffuse_green", PlySlot::green},
     {"blue", PlySlot::blue},   {"diffuse_blue", PlySlot::blue},
     {"alpha", PlySlot::alpha}, {"diffuse_alpha", PlySlot::alpha}}};

constexpr std::size_t indexOf(PlySlot slot) {
  return static_cast<std::size_t>(slot);
}

PlySlot slotOf(const PlyProperty& property) {
  if (!property.isList())
    for (const auto& [name, slot] : vertexProperties)
      if (property.name == name)
        return slot;
  return PlySlot::unknown;
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
    PlySlot slot = slotOf(property);
    if (present_[indexOf(slot)])
      slot = PlySlot::unknown; // a second property of the same meaning, as u beside s
    slots_.push_back(slot);
    if (slot != PlySlot::unknown) {
      present_[indexOf(slot)] = true;
      types_[indexOf(slot)] = property.type;
    }
  }
  chooseNamed(kept);
  for (std::size_t p = 0; p < slots_.size(); ++p)
    if (slots_[p] == PlySlot::unknown && (named_.empty() || named_[p] == nullptr))
      content.noteIgnored(element, element.properties[p]);
  hasNormal_ = has(PlySlot::nx, PlySlot::nz);
  hasTexCoord_ = has(PlySlot::u, PlySlot::v);
  hasColor_ = has(PlySlot::red, PlySlot::blue);
  hasAlpha_ = has(PlySlot::alpha, PlySlot::alpha);
  isDouble_ = std::ranges::any_of(std::span(types_).first(3), [](PlyType type) { return type == PlyType::float64; });
}

void PlyVertexReader::chooseNamed(const AttributeChoice& kept) {
  const std::vector<PlyProperty>& properties = element_.properties;
  const auto isFree = [&](std::size_t p) {
    return slots_[p] == PlySlot::unknown && !properties[p].isList() && isPlain(properties[p].name);
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

bool PlyVertexReader::has(PlySlot first, PlySlot last) const {
  return std::all_of(&present_[indexOf(first)], &present_[indexOf(last)] + 1, [](bool there) { return there; });
}

bool PlyVertexReader::isFinite(PlySlot first, PlySlot last) const {
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
std::uint8_t PlyVertexReader::channel(PlySlot slot) {
  const PlyType type = types_[indexOf(slot)];
  const double scale = type == PlyType::uint16 ? 1 / 257.0 : isInteger(type) ? 1 : 255;
  const double scaled = value(slot) * scale;
  if (scaled >= 0 && scaled < 255.5)
    return static_cast<std::uint8_t>(std::lround(scaled));
  ++content_.colorsClamped;
  return scaled > 0 ? 255 : 0; // NaN becomes 0
}

void PlyVertexReader::noteRounding() {
  for (const PlySlot slot : {PlySlot::x, PlySlot::y, PlySlot::z}) {
    const double rounded = static_cast<float>(value(slot));
    content_.maxRounding = std::max(content_.maxRounding, std::abs(value(slot) - rounded));
  }
}

const char* PlyVertexReader::addVertex() {
  const auto f = [&](PlySlot slot) { return static_cast<float>(value(slot)); };
  if (!isFinite(PlySlot::x, PlySlot::z))
    return "a coordinate is not a number or beyond single precision";
  content_.positions.push_back({f(PlySlot::x), f(PlySlot::y), f(PlySlot::z)});
  if (isDouble_)
    noteRounding();
  if (hasNormal_)
    content_.attributes.normals.push_back({f(PlySlot::nx), f(PlySlot::ny), f(PlySlot::nz)});
  if (hasTexCoord_) {
    if (!isFinite(PlySlot::u, PlySlot::v))
      return "a texture coordinate is not a number";
    content_.attributes.texCoords.push_back({f(PlySlot::u), f(PlySlot::v)});
  }
  if (hasColor_) {
    const std::uint8_t red = channel(PlySlot::red), green = channel(PlySlot::green), blue = channel(PlySlot::blue);
    const std::uint8_t alpha = hasAlpha_ ? channel(PlySlot::alpha) : 255;
    content_.attributes.colors.push_back({red, green, blue, alpha});
    if (alpha < 255)
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
