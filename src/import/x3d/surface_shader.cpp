#include "import/x3d/surface_shader.h"

#include "import/x3d/element_edits.h"
#include "scene/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace imgeo::x3d {

namespace {

using namespace std::string_view_literals;
using Color = std::vector<double>; // red, green, blue

/// A texture field of the shader, and the fields of Material and PhysicalMaterial that it becomes.
struct TextureField {
  std::string_view shader, material, physical; ///< "": the material has no such texture
};
constexpr std::array textureFields{
    TextureField{"ambientTexture", "ambientTexture", ""},
    TextureField{"diffuseTexture", "diffuseTexture", "baseTexture"},
    TextureField{"emissiveTexture", "emissiveTexture", "emissiveTexture"},
    TextureField{"normalTexture", "normalTexture", "normalTexture"},
    TextureField{"shininessTexture", "shininessTexture", ""},
    TextureField{"specularTexture", "specularTexture", ""},
};

/// The defaults of fields that no material has. With another value, they are reported.
const std::map<std::string_view, std::string_view>& defaultsOfOtherFields() {
  static const std::map<std::string_view, std::string_view> defaults{
      {"environmentFactor", "1 1 1"}, {"fresnelBlend", "0"},         {"invisible", "false"},
      {"normalBias", "-1 -1 -1"},     {"normalFormat", "UNORM"},     {"normalScale", "2 2 2"},
      {"normalSpace", "TANGENT"},     {"reflectionFactor", "0 0 0"}, {"relativeIndexOfRefraction", "1"},
      {"transmissionFactor", "0 0 0"}};
  return defaults;
}

double mean(const Color& color) {
  return (color.at(0) + color.at(1) + color.at(2)) / 3;
}

Color colorOf(pugi::xml_node element, const char* field, double fallback) {
  return numbersOf(element, field, {fallback, fallback, fallback});
}

double numberOf(pugi::xml_node element, const char* field, double fallback) {
  return numbersOf(element, field, {fallback})[0];
}

std::string textOf(const Color& color) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", color[0], color[1], color[2]);
}

/// The color with linear numbers, as PhysicalMaterial has them; materials of Phong's model have sRGB's.
Color linear(Color color) {
  for (double& value : color)
    value = linearOfSrgb(std::clamp(value, 0.0, 1.0));
  return color;
}

/// Whether the shader has light that a Material cannot express: reflections of the surroundings or transmitted light.
bool needsPhysicalMaterial(pugi::xml_node shader) {
  for (const pugi::xml_node& child : elementsOf(shader))
    if (const std::string_view field = child.attribute("containerField").value();
        field == "environmentTexture" || field == "reflectionTexture" || field == "transmissionTexture")
      return true;
  return mean(colorOf(shader, "reflectionFactor", 0)) > 0 || mean(colorOf(shader, "transmissionFactor", 0)) > 0 ||
         numberOf(shader, "fresnelBlend", 0) > 0;
}

/// The share of light that comes back from a surface seen from the front: reflectionFactor, of which fresnelBlend is
/// the share that follows Fresnel's equations for the index of refraction.
Color reflectance(pugi::xml_node shader) {
  const double index = numberOf(shader, "relativeIndexOfRefraction", 1),
               fresnel = std::clamp(numberOf(shader, "fresnelBlend", 0), 0.0, 1.0);
  constexpr double ofGlass = 0.04; // of an index of refraction of 1.5
  const double atFront = index > 0 && index != 1 ? (index - 1) * (index - 1) / ((index + 1) * (index + 1)) : ofGlass;
  const bool hasFactor = shader.attribute("reflectionFactor");
  const Color environment = colorOf(shader, "environmentFactor", 1);
  // A shader that names only an environment, or only Fresnel's term, reflects all of it.
  Color color = hasFactor ? colorOf(shader, "reflectionFactor", 0) : Color{1, 1, 1};
  for (std::size_t i = 0; i < color.size(); ++i)
    color[i] = std::clamp(color[i] * environment[i] * (1 - fresnel + fresnel * atFront), 0.0, 1.0);
  return color;
}

std::string transparencyOf(pugi::xml_node shader) {
  const bool isInvisible = parseBoolean(shader.attribute("invisible").value(), false);
  return fmt::format("{:.4g}", isInvisible ? 1 : std::clamp(1 - numberOf(shader, "alphaFactor", 1), 0.0, 1.0));
}

void setTransparency(pugi::xml_node shader) {
  if (shader.attribute("alphaFactor") || shader.attribute("invisible"))
    setField(shader, "transparency", transparencyOf(shader));
  shader.remove_attribute("alphaFactor");
  shader.remove_attribute("invisible");
}

pugi::xml_node addExtension(pugi::xml_node material, const char* name) {
  pugi::xml_node extension = material.append_child(name);
  extension.append_attribute("containerField") = "extensions";
  return extension;
}

bool isFieldOfMaterial(std::string_view field) {
  static constexpr std::array fields{"DEF"sv,           "ambientIntensity"sv, "baseColor"sv,     "diffuseColor"sv,
                                     "emissiveColor"sv, "metallic"sv,         "roughness"sv,     "shininess"sv,
                                     "specularColor"sv, "transparency"sv,     "containerField"sv};
  return isOneOf(fields, field) || field.ends_with("Mapping");
}

/// Whether a field can be removed without a report: it identifies an element, selects the channels or the first set of
/// texture coordinates of a texture, or has its default value.
bool isWithoutEffect(std::string_view field, std::string_view value) {
  if (field == "id" || field == "class" || field.ends_with("TextureId") || field.ends_with("ChannelMask"))
    return true;
  if (field.ends_with("CoordinatesId"))
    return value == "0" || value == "-1";
  const auto found = defaultsOfOtherFields().find(field);
  if (found == defaultsOfOtherFields().end())
    return false;
  const std::optional<std::vector<double>> numbers = parseReals(value);
  return value == found->second || (numbers && numbers == parseReals(found->second));
}

} // namespace

void SurfaceShaders::noteLeftOut(const std::string& field) {
  ++result_.leftOut[fmt::format("the {} of CommonSurfaceShader", field)];
}

void SurfaceShaders::convert(pugi::xml_node shader) {
  for (const pugi::xml_node& sibling : elementsOf(shader.parent()))
    if (sibling != shader && isMaterialNode(sibling.name()))
      takeOut_(sibling);
  const pugi::xml_attribute use = shader.attribute("USE");
  const bool isPhysical = use ? physicalDefs_.contains(use.value()) : needsPhysicalMaterial(shader);
  const char* name = isPhysical ? "PhysicalMaterial" : "Material";
  ++result_.converted[fmt::format("{} as {}", shader.name(), name)];
  shader.set_name(name);
  shader.remove_attribute("containerField");
  if (use)
    return;
  if (isPhysical && shader.attribute("DEF"))
    physicalDefs_.insert(shader.attribute("DEF").value());
  convertTextures(shader, isPhysical);
  if (isPhysical)
    makePhysicalMaterial(shader);
  else
    makeMaterial(shader);
  removeOtherFields(shader);
}

/// A Material has the factors under other names.
void SurfaceShaders::makeMaterial(pugi::xml_node shader) {
  const Color ambient = colorOf(shader, "ambientFactor", .2), diffuse = colorOf(shader, "diffuseFactor", .8);
  if (const double brightness = mean(diffuse); brightness > 0) // X3D: ambient = ambientIntensity * diffuseColor
    setField(shader, "ambientIntensity", fmt::format("{:.4g}", std::clamp(mean(ambient) / brightness, 0.0, 1.0)));
  shader.remove_attribute("ambientFactor");
  renameField(shader, "diffuseFactor", "diffuseColor");
  renameField(shader, "emissiveFactor", "emissiveColor");
  renameField(shader, "specularFactor", "specularColor");
  renameField(shader, "shininessFactor", "shininess");
  setTransparency(shader);
}

/// A dielectric whose reflectance is the shader's: that of an index of refraction of 1000 is 1, times specularColor.
void SurfaceShaders::makePhysicalMaterial(pugi::xml_node shader) {
  setField(shader, "baseColor", textOf(linear(colorOf(shader, "diffuseFactor", .8))));
  if (shader.attribute("emissiveFactor"))
    setField(shader, "emissiveColor", textOf(linear(colorOf(shader, "emissiveFactor", 0))));
  setField(shader, "metallic", "0");
  // The lobe of Phong's exponent n is as wide as a microfacet lobe of alpha = sqrt(2 / (n + 2)); alpha = roughness^2.
  const double exponent = 128 * std::clamp(numberOf(shader, "shininessFactor", .2), 0.0, 1.0);
  setField(shader, "roughness", fmt::format("{:.4g}", std::sqrt(std::sqrt(2 / (exponent + 2)))));
  setTransparency(shader);
  addExtension(shader, "IORMaterialExtension").append_attribute("indexOfRefraction") = "1000";
  addExtension(shader, "SpecularMaterialExtension").append_attribute("specularColor") =
      textOf(reflectance(shader)).c_str();
  if (const double transmission = mean(colorOf(shader, "transmissionFactor", 0)); transmission > 0)
    addExtension(shader, "TransmissionMaterialExtension").append_attribute("transmission") =
        fmt::format("{:.4g}", std::clamp(transmission, 0.0, 1.0)).c_str();
  for (const char* field :
       {"diffuseFactor", "emissiveFactor", "shininessFactor", "environmentFactor", "reflectionFactor", "fresnelBlend",
        "relativeIndexOfRefraction", "transmissionFactor", "ambientFactor", "specularFactor"})
    shader.remove_attribute(field); // what a light adds follows from roughness and reflectance
}

void SurfaceShaders::convertTextures(pugi::xml_node shader, bool isPhysical) {
  for (const pugi::xml_node& child : elementsOf(shader)) {
    const std::string_view given = child.attribute("containerField").value();
    const std::string_view element = child.name();
    if (element.starts_with("Metadata"))
      continue;
    const auto row = std::ranges::find(textureFields, given, &TextureField::shader);
    const bool isTexture = element == "SurfaceShaderTexture" || isTextureNode(element);
    const std::string field(!isTexture || row == textureFields.end() ? ""sv
                            : isPhysical                             ? row->physical
                                                                     : row->material);
    if (field.empty()) {
      noteLeftOut(given.empty() ? std::string(element) : std::string(given));
      takeOut_(child);
    } else if (element == "SurfaceShaderTexture") {
      unwrapTexture(shader, child, field);
    } else {
      setField(child, "containerField", field);
    }
  }
}

/// Puts the texture within a SurfaceShaderTexture into a field of the material.
void SurfaceShaders::unwrapTexture(pugi::xml_node material, pugi::xml_node wrapper, const std::string& field) {
  for (pugi::xml_node child : elementsOf(wrapper))
    if (isTextureNode(child.name())) {
      setField(child, "containerField", field);
      material.append_move(child);
    } else if (std::string_view(child.name()) == "TextureTransform" && !child.attribute("USE")) {
      const std::string mapping = fmt::format("{}-{}", field, ++mappings_);
      setField(child, "mapping", mapping);
      setField(material, (field + "Mapping").c_str(), mapping);
      child.remove_attribute("containerField");
      material.parent().append_move(child);
    }
  ++result_.converted["SurfaceShaderTexture as its texture"];
  takeOut_(wrapper);
}

/// Removes the fields that no material has, and notes those that would have an effect.
void SurfaceShaders::removeOtherFields(pugi::xml_node shader) {
  const auto all = shader.attributes();
  for (const pugi::xml_attribute& field : std::vector<pugi::xml_attribute>(all.begin(), all.end()))
    if (!isFieldOfMaterial(field.name())) {
      if (!isWithoutEffect(field.name(), field.value()))
        noteLeftOut(field.name());
      shader.remove_attribute(field);
    }
}

} // namespace imgeo::x3d
