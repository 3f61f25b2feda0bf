#include "import/ply_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace imgeo {

namespace {

constexpr std::array<std::pair<const char*, PlySlot>, 22> kVertexProperties{
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

constexpr std::size_t place(PlySlot slot) {
  return static_cast<std::size_t>(slot);
}

PlySlot slotOf(const PlyProperty& property) {
  if (!property.isList())
    for (const auto& [name, slot] : kVertexProperties)
      if (property.name == name)
        return slot;
  return PlySlot::unknown;
}

} // namespace

PlyVertexReader::PlyVertexReader(const PlyElement& element, PlyContent& content)
    : element_(element), content_(content) {
  for (const PlyProperty& property : element.properties) {
    PlySlot slot = slotOf(property);
    if (present_[place(slot)])
      slot = PlySlot::unknown; // both s and u: the first counts
    slots_.push_back(slot);
    if (slot == PlySlot::unknown) {
      content.noteIgnored(element, property);
    } else {
      present_[place(slot)] = true;
      types_[place(slot)] = property.type;
    }
  }
  hasNormal_ = has(PlySlot::nx, PlySlot::nz);
  hasTexCoord_ = has(PlySlot::u, PlySlot::v);
  hasColor_ = has(PlySlot::red, PlySlot::blue);
  hasAlpha_ = has(PlySlot::alpha, PlySlot::alpha);
  isDouble_ =
      std::ranges::any_of(std::span(types_).first(3), [](PlyType type) { return type == PlyType::float64; });
}

bool PlyVertexReader::has(PlySlot first, PlySlot last) const {
  return std::all_of(&present_[place(first)], &present_[place(last)] + 1, [](bool there) { return there; });
}

bool PlyVertexReader::isFinite(PlySlot first, PlySlot last) const {
  return std::all_of(&values_[place(first)], &values_[place(last)] + 1,
                     [](double value) { return std::isfinite(static_cast<float>(value)); });
}

void PlyVertexReader::reserve() {
  const std::size_t count = element_.count;
  content_.positions.reserve(count);
  content_.normals.reserve(hasNormal_ ? count : 0);
  content_.texCoords.reserve(hasTexCoord_ ? count : 0);
  content_.colors.reserve(hasColor_ ? count : 0);
}

/// 16 bits are spread over 0 .. 65,535, fractions over 0 .. 1; all others hold 0 .. 255.
std::uint8_t PlyVertexReader::channel(PlySlot slot) {
  const PlyType type = types_[place(slot)];
  const double scale = type == PlyType::uint16 ? 1 / 257.0 : isInteger(type) ? 1 : 255;
  const double scaled = value(slot) * scale;
  if (scaled >= 0 && scaled < 255.5)
    return static_cast<std::uint8_t>(std::lround(scaled));
  ++content_.colorsClamped;
  return scaled > 0 ? 255 : 0; // what is not a number becomes 0
}

void PlyVertexReader::noteRounding() {
  for (const PlySlot slot : {PlySlot::x, PlySlot::y, PlySlot::z}) {
    const double rounded = static_cast<float>(value(slot));
    content_.largestRounding = std::max(content_.largestRounding, std::abs(value(slot) - rounded));
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
    content_.normals.push_back({f(PlySlot::nx), f(PlySlot::ny), f(PlySlot::nz)});
  if (hasTexCoord_) {
    if (!isFinite(PlySlot::u, PlySlot::v))
      return "a texture coordinate is not a number";
    content_.texCoords.push_back({f(PlySlot::u), f(PlySlot::v)});
  }
  if (hasColor_) {
    const std::uint8_t red = channel(PlySlot::red), green = channel(PlySlot::green),
                       blue = channel(PlySlot::blue);
    const std::uint8_t alpha = hasAlpha_ ? channel(PlySlot::alpha) : 255;
    content_.colors.push_back({red, green, blue, alpha});
    content_.hasAlpha |= alpha < 255;
  }
  return nullptr;
}

} // namespace imgeo
