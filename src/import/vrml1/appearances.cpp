#include "import/vrml1/appearances.h"

#include "import/text/rounded_decimal.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace imgeo::vrml1 {

namespace {

constexpr std::initializer_list<std::pair<const char*, std::size_t>> materialFields{
    {"ambientColor", 3},  {"diffuseColor", 3}, {"specularColor", 3},
    {"emissiveColor", 3}, {"shininess", 1},    {"transparency", 1}};

/// The value of a field at an index; the last value for larger indices, 0 for an empty list, the fallback for an absent
/// field.
Vec3d colorAt(const Node& material, const char* field, std::size_t index, Vec3d fallback) {
  const std::vector<double>& values = material.numbers(field);
  if (values.size() < 3)
    return material.field(field) ? Vec3d{} : fallback;
  const std::size_t at = 3 * std::min(index, values.size() / 3 - 1);
  return {values[at], values[at + 1], values[at + 2]};
}

double numberAt(const Node& material, const char* field, std::size_t index, double fallback) {
  const std::vector<double>& values = material.numbers(field);
  return values.empty() ? fallback : values[std::min(index, values.size() - 1)];
}

double sum(const Vec3d& v) {
  return v.x + v.y + v.z;
}

bool isTextureWithImage(const Node* texture) {
  return texture && (!texture->word("filename", "").empty() || texture->numbers("image").size() > 3);
}

std::string contentOf(pugi::xml_node element) {
  std::ostringstream text;
  for (const pugi::xml_node& child : element.children())
    child.print(text, "", pugi::format_raw);
  return text.str();
}

} // namespace

Surfaces::Surfaces(const Node* material) : material_(material) {
  if (material)
    for (const auto& [field, size] : materialFields)
      count_ = std::max(count_, material->numbers(field).size() / size);
}

Surface Surfaces::at(std::size_t index) const {
  Surface surface;
  if (!material_)
    return surface;
  index %= count_;
  surface.diffuse = colorAt(*material_, "diffuseColor", index, surface.diffuse);
  surface.emissive = colorAt(*material_, "emissiveColor", index, {});
  surface.specular = colorAt(*material_, "specularColor", index, {});
  surface.shininess = numberAt(*material_, "shininess", index, surface.shininess);
  surface.transparency = numberAt(*material_, "transparency", index, 0);
  if (material_->field("ambientColor")) {
    const double ambient = sum(colorAt(*material_, "ambientColor", index, {})), diffuse = sum(surface.diffuse);
    surface.ambientIntensity = rounded(diffuse > 0 ? std::clamp(ambient / diffuse, 0.0, 1.0) : 0, 4);
  }
  return surface;
}

bool Surfaces::differInMoreThanColor() const {
  const auto hasSeveral = [&](const char* field, std::size_t size) {
    return material_ && material_->numbers(field).size() > size;
  };
  return hasSeveral("specularColor", 3) || hasSeveral("emissiveColor", 3) || hasSeveral("shininess", 1);
}

Vec3d unlitColor(const Surface& surface) {
  return surface.emissive == Vec3d{} ? surface.diffuse : surface.emissive;
}

std::string textOf(const Vec3d& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

bool Appearances::isTextured(Properties& properties) {
  return isTextureWithImage(properties.get(Property::texture));
}

void Appearances::add(pugi::xml_node shape, const Node& where, const Surface& surface, bool isLit,
                      Properties& properties) {
  pugi::xml_node appearance = elements_.add(shape, "Appearance", where.where);
  addMaterial(appearance, where, surface, isLit);
  if (isLit && isTextured(properties)) {
    addTexture(appearance, where, *properties.get(Property::texture));
    if (const Node* const transform = properties.get(Property::textureTransform))
      addTextureTransform(appearance, where, *transform);
  }
  const auto [found, isNew] = written_.try_emplace(contentOf(appearance), appearance);
  if (isNew)
    return;
  appearance.remove_children();
  if (!found->second.attribute("DEF")) {
    const Node* const material = properties.get(Property::material);
    const std::string name = material && !material->name.empty() ? material->name : "Appearance";
    x3d::set(found->second, "DEF", elements_.define(name, "Appearance"));
  }
  x3d::set(appearance, "USE", found->second.attribute("DEF").value());
}

void Appearances::addMaterial(pugi::xml_node appearance, const Node& where, const Surface& surface, bool isLit) {
  pugi::xml_node material = elements_.add(appearance, "Material", where.where);
  const Surface initial;
  if (!isLit) {
    x3d::set(material, "diffuseColor", "0 0 0");
    x3d::set(material, "emissiveColor", textOf(unlitColor(surface)));
  } else {
    if (surface.diffuse != initial.diffuse)
      x3d::set(material, "diffuseColor", textOf(surface.diffuse));
    if (surface.emissive != initial.emissive)
      x3d::set(material, "emissiveColor", textOf(surface.emissive));
    if (surface.specular != initial.specular)
      x3d::set(material, "specularColor", textOf(surface.specular));
    if (surface.shininess != initial.shininess)
      x3d::set(material, "shininess", fmt::format("{}", surface.shininess));
    if (surface.ambientIntensity)
      x3d::set(material, "ambientIntensity", fmt::format("{}", *surface.ambientIntensity));
  }
  if (surface.transparency != 0)
    x3d::set(material, "transparency", fmt::format("{}", surface.transparency));
}

void Appearances::addTexture(pugi::xml_node appearance, const Node& where, const Node& texture) {
  const std::string file = texture.word("filename", "");
  pugi::xml_node element = elements_.add(appearance, file.empty() ? "PixelTexture" : "ImageTexture", where.where);
  if (file.empty())
    x3d::set(element, "image", fmt::format("{}", fmt::join(texture.numbers("image"), " ")));
  else
    x3d::set(element, "url", quoteStrings({file}));
  if (texture.word("wrapS", "REPEAT") == "CLAMP")
    x3d::set(element, "repeatS", "false");
  if (texture.word("wrapT", "REPEAT") == "CLAMP")
    x3d::set(element, "repeatT", "false");
}

/// VRML 1.0 scales and rotates texture coordinates about the center and then translates them: M (c - center) + center +
/// translation, with M = rotation * scale. X3D translates first and then rotates and scales: scale * rotation *
/// (c + translation). The two products are equal where the scale is uniform or the rotation is none.
void Appearances::addTextureTransform(pugi::xml_node appearance, const Node& where, const Node& node) {
  const auto pair = [&](const char* field, Vec2<double> fallback) {
    const std::vector<double>& v = node.numbers(field);
    return v.size() < 2 ? fallback : Vec2<double>{v[0], v[1]};
  };
  const Vec2<double> translation = pair("translation", {0, 0}), scale = pair("scaleFactor", {1, 1}),
                     center = pair("center", {0, 0});
  const double angle = node.real("rotation", 0), c = std::cos(angle), s = std::sin(angle);
  if (scale.x == 0 || scale.y == 0)
    return;
  if (angle != 0 && scale.x != scale.y)
    ++report_.shearedTextures;
  const Vec2<double> offset{center.x + translation.x - (c * scale.x * center.x - s * scale.y * center.y),
                            center.y + translation.y - (s * scale.x * center.x + c * scale.y * center.y)};
  const Vec2<double> unscaled{offset.x / scale.x, offset.y / scale.y};
  const Vec2<double> first{c * unscaled.x + s * unscaled.y, c * unscaled.y - s * unscaled.x};
  pugi::xml_node element = elements_.add(appearance, "TextureTransform", where.where);
  if (first.x != 0 || first.y != 0)
    x3d::set(element, "translation", fmt::format("{} {}", rounded(first.x, 8), rounded(first.y, 8)));
  if (angle != 0)
    x3d::set(element, "rotation", fmt::format("{}", angle));
  if (scale.x != 1 || scale.y != 1)
    x3d::set(element, "scale", fmt::format("{} {}", scale.x, scale.y));
}

} // namespace imgeo::vrml1
