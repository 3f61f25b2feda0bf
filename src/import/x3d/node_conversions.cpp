#include "import/x3d/node_conversions.h"

#include "import/x3d/field_values.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

using namespace std::string_view_literals;

std::vector<pugi::xml_node> elementsOf(pugi::xml_node parent) {
  std::vector<pugi::xml_node> elements;
  for (const pugi::xml_node& child : parent.children())
    if (child.type() == pugi::node_element)
      elements.push_back(child);
  return elements;
}

bool isOneOf(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

bool isTextureNode(std::string_view element) {
  return element == "ImageTexture" || element == "PixelTexture" || element == "MultiTexture";
}

bool isMaterialNode(std::string_view element) {
  return element == "Material" || element == "PhysicalMaterial" || element == "UnlitMaterial" ||
         element == "TwoSidedMaterial";
}

void setField(pugi::xml_node element, const char* field, const std::string& value) {
  if (!element.attribute(field))
    element.append_attribute(field);
  element.attribute(field).set_value(value.c_str());
}

/// Gives a field another name; keeps a field that already has that name.
void renameField(pugi::xml_node element, const char* from, const char* to) {
  if (const pugi::xml_attribute given = element.attribute(from); given && !element.attribute(to))
    element.append_attribute(to) = given.value();
  element.remove_attribute(from);
}

double average(const std::vector<double>& color) {
  return color.empty() ? 0 : (color[0] + color.at(1) + color.at(2)) / 3;
}

/// The numbers of a field; `fallback` where the field has fewer numbers than `fallback`.
std::vector<double> numbersOf(pugi::xml_node element, const char* field, const std::vector<double>& fallback) {
  std::optional<std::vector<double>> values = parseReals(element.attribute(field).value());
  if (!values || values->size() < fallback.size())
    return fallback;
  return std::move(*values);
}

class NodeConverter {
public:
  explicit NodeConverter(Elements& elements) : elements_(elements) {}

  NodeConversions run() {
    const char* version = elements_.root().attribute("version").value();
    hasVisiblePerChild_ = *version != '\0' && *version < '4';
    convertBelow(elements_.root().child("Scene"));
    convertBelow(takenOut_);
    return std::move(result_);
  }

private:
  void convertBelow(pugi::xml_node parent) {
    for (const pugi::xml_node& element : elementsOf(parent)) {
      convert(element); // before its children: it needs their containerField, which their conversion removes
      convertBelow(element);
    }
  }

  void convert(pugi::xml_node element) {
    using Convert = void (NodeConverter::*)(pugi::xml_node);
    static const std::map<std::string_view, Convert> conversions{
        {"CADAssembly", &NodeConverter::makeGroup},
        {"CADFace", &NodeConverter::makeGroup},
        {"CADLayer", &NodeConverter::convertCadLayer},
        {"CADPart", &NodeConverter::makeTransform},
        {"CollidableOffset", &NodeConverter::makeTransform},
        {"CollidableShape", &NodeConverter::makeTransform},
        {"CommonSurfaceShader", &NodeConverter::convertSurfaceShader},
        {"EspduTransform", &NodeConverter::makeTransform},
        {"HAnimHumanoid", &NodeConverter::convertHumanoid},
        {"HAnimJoint", &NodeConverter::makeTransform},
        {"HAnimSegment", &NodeConverter::convertSegment},
        {"HAnimSite", &NodeConverter::makeTransform},
        {"Layer", &NodeConverter::makeGroup},
        {"LayerSet", &NodeConverter::makeGroup},
        {"PhysicalMaterial", &NodeConverter::convertPhysicalMaterial},
        {"PickableGroup", &NodeConverter::makeGroup},
        {"TwoSidedMaterial", &NodeConverter::convertTwoSidedMaterial},
        {"ViewpointGroup", &NodeConverter::makeGroup},
    };
    if (const auto found = conversions.find(element.name()); found != conversions.end())
      (this->*found->second)(element);
  }

  void rename(pugi::xml_node element, const char* name) {
    ++result_.converted[fmt::format("{} as {}", element.name(), name)];
    element.set_name(name);
    element.remove_attribute("containerField"); // its default is the field of the new node
  }

  void makeGroup(pugi::xml_node element) { rename(element, "Group"); }
  void makeTransform(pugi::xml_node element) { rename(element, "Transform"); }

  /// Takes an element out of the scene; its DEF names stay known.
  void takeOut(pugi::xml_node element) {
    if (!takenOut_)
      takenOut_ = elements_.root().append_child("takenOut");
    takenOut_.append_move(element);
  }

  /// Before X3D 4 a CADLayer has a value of `visible` for each child.
  void convertCadLayer(pugi::xml_node layer) {
    makeGroup(layer);
    if (!hasVisiblePerChild_ || !layer.attribute("visible"))
      return;
    const std::string values = layer.attribute("visible").value();
    layer.remove_attribute("visible");
    std::size_t at = 0;
    for (const pugi::xml_node& child : elementsOf(layer)) {
      const std::size_t begin = values.find_first_not_of(" \t\r\n,", at);
      if (begin == values.npos)
        return;
      at = std::min(values.find_first_of(" \t\r\n,", begin), values.size());
      if (values.substr(begin, at - begin) == "false") {
        pugi::xml_node hidden = layer.insert_child_before("Group", child);
        hidden.append_attribute("visible") = "false";
        elements_.offsets[hidden.internal_object()] = elements_.offsetOf(child);
        hidden.append_move(child);
      }
    }
  }

  /// A humanoid lists the nodes of its skeleton again, and holds the points of its skin, which are no nodes of the
  /// scene.
  void convertHumanoid(pugi::xml_node humanoid) {
    static constexpr std::array lists{"joints"sv,
                                      "segments"sv,
                                      "sites"sv,
                                      "skinCoord"sv,
                                      "skinNormal"sv,
                                      "skinBindingCoords"sv,
                                      "skinBindingNormals"sv};
    for (const pugi::xml_node& child : elementsOf(humanoid))
      if (isOneOf(lists, child.attribute("containerField").value()) || !isChildNode(child))
        takeOut(child);
    makeTransform(humanoid);
  }

  void convertSegment(pugi::xml_node segment) {
    for (const pugi::xml_node& child : elementsOf(segment))
      if (!isChildNode(child))
        takeOut(child);
    makeGroup(segment);
  }

  /// Whether an element can be a child of a group.
  static bool isChildNode(pugi::xml_node element) {
    static constexpr std::array others{"Coordinate"sv, "Normal"sv, "HAnimDisplacer"sv};
    return !isOneOf(others, element.name());
  }

  void convertTwoSidedMaterial(pugi::xml_node material) {
    rename(material, "Material");
    for (const char* field : {"separateBackColor", "backAmbientIntensity", "backDiffuseColor", "backEmissiveColor",
                              "backShininess", "backSpecularColor", "backTransparency"})
      material.remove_attribute(field);
  }

  /// X3DOM's and InstantReality's shader has the fields of a Material under other names, and other defaults. It
  /// replaces the Material beside it.
  void convertSurfaceShader(pugi::xml_node shader) {
    for (const pugi::xml_node& sibling : elementsOf(shader.parent()))
      if (sibling != shader && isMaterialNode(sibling.name()))
        takeOut(sibling);
    rename(shader, "Material");
    if (shader.attribute("USE"))
      return;
    convertSurfaceFactors(shader);
    convertSurfaceTextures(shader);
    for (const pugi::xml_attribute& field : attributesOf(shader))
      if (!isFieldOfMaterial(field.name()))
        shader.remove_attribute(field);
  }

  static std::vector<pugi::xml_attribute> attributesOf(pugi::xml_node element) {
    const auto all = element.attributes();
    return {all.begin(), all.end()};
  }

  static bool isFieldOfMaterial(std::string_view field) {
    static constexpr std::array fields{"DEF"sv,           "ambientIntensity"sv, "diffuseColor"sv, "emissiveColor"sv,
                                       "specularColor"sv, "shininess"sv,        "transparency"sv};
    return isOneOf(fields, field) || field.ends_with("Mapping");
  }

  static void convertSurfaceFactors(pugi::xml_node shader) {
    const std::vector<double> ambient = numbersOf(shader, "ambientFactor", {.2, .2, .2}),
                              diffuse = numbersOf(shader, "diffuseFactor", {.8, .8, .8});
    if (const double brightness = average(diffuse); brightness > 0) // X3D: ambient = ambientIntensity * diffuseColor
      setField(shader, "ambientIntensity", fmt::format("{:.4g}", std::clamp(average(ambient) / brightness, 0.0, 1.0)));
    renameField(shader, "diffuseFactor", "diffuseColor");
    renameField(shader, "emissiveFactor", "emissiveColor");
    renameField(shader, "specularFactor", "specularColor");
    renameField(shader, "shininessFactor", "shininess");
    if (shader.attribute("alphaFactor"))
      setField(shader, "transparency",
               fmt::format("{:.4g}", std::clamp(1 - numbersOf(shader, "alphaFactor", {1})[0], 0.0, 1.0)));
  }

  void convertSurfaceTextures(pugi::xml_node shader) {
    static constexpr std::array roles{"ambientTexture"sv, "diffuseTexture"sv,   "emissiveTexture"sv,
                                      "normalTexture"sv,  "shininessTexture"sv, "specularTexture"sv};
    for (const pugi::xml_node& child : elementsOf(shader)) {
      const std::string field = child.attribute("containerField").value();
      const std::string_view element = child.name();
      if (element != "SurfaceShaderTexture" && !isTextureNode(element))
        continue;
      if (!isOneOf(roles, field)) {
        ++result_.leftOut[fmt::format("the {} of CommonSurfaceShader", field.empty() ? "texture" : field)];
        takeOut(child);
      } else if (element == "SurfaceShaderTexture") {
        unwrapTexture(shader, child, field);
      }
    }
  }

  /// Puts the texture within a SurfaceShaderTexture into the field of the SurfaceShaderTexture.
  void unwrapTexture(pugi::xml_node material, pugi::xml_node wrapper, const std::string& field) {
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
    takeOut(wrapper);
  }

  /// X3DOM's node of this name has the fields of glTF.
  void convertPhysicalMaterial(pugi::xml_node material) {
    const bool isOfX3dom = std::ranges::any_of(material.attributes(), [](const pugi::xml_attribute& field) {
      return std::string_view(field.name()).ends_with("Factor");
    });
    if (!isOfX3dom)
      return;
    ++result_.converted["X3DOM's PhysicalMaterial as X3D's"];
    const std::vector<double> base = numbersOf(material, "baseColorFactor", {1, 1, 1});
    setField(material, "baseColor", fmt::format("{} {} {}", base[0], base[1], base[2]));
    if (base.size() > 3)
      setField(material, "transparency", fmt::format("{:.4g}", std::clamp(1 - base[3], 0.0, 1.0)));
    setField(material, "metallic", fmt::format("{}", numbersOf(material, "metallicFactor", {0})[0]));
    setField(material, "roughness", fmt::format("{}", numbersOf(material, "roughnessFactor", {.2})[0]));
    renameField(material, "emissiveFactor", "emissiveColor");
    for (const char* field : {"baseColorFactor", "metallicFactor", "roughnessFactor"})
      material.remove_attribute(field);
    for (const char* field : {"alphaMode", "alphaCutoff"}) { // X3D: fields of the Appearance
      if (material.attribute(field) && !material.parent().attribute(field))
        setField(material.parent(), field, material.attribute(field).value());
      material.remove_attribute(field);
    }
    for (const pugi::xml_node& texture : elementsOf(material)) {
      const std::string_view field = texture.attribute("containerField").value();
      if (field == "baseColorTexture")
        setField(texture, "containerField", "baseTexture");
      if (field == "roughnessMetallicTexture" || field == "occlusionRoughnessMetallicTexture")
        setField(texture, "containerField", "metallicRoughnessTexture");
    }
  }

  Elements& elements_;
  pugi::xml_node takenOut_;
  bool hasVisiblePerChild_ = false;
  std::size_t mappings_ = 0; ///< the number in the last mapping that was invented
  NodeConversions result_;
};

} // namespace

NodeConversions convertNodes(Elements& elements) {
  return NodeConverter(elements).run();
}

} // namespace imgeo::x3d
