#include "import/x3d/node_conversions.h"

#include "import/x3d/element_edits.h"
#include "import/x3d/surface_shader.h"
#include "import/x3d/unlit_geometry.h"

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

class NodeConverter {
public:
  explicit NodeConverter(Elements& elements)
      : elements_(elements), definitions_(shapeDefinitionsOf(elements.root())),
        surfaceShaders_(result_, [this](pugi::xml_node element) { takeOut(element); }) {}

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
        {"HAnimJoint", &NodeConverter::convertJoint},
        {"HAnimSegment", &NodeConverter::convertSegment},
        {"HAnimSite", &NodeConverter::makeTransform},
        {"Layer", &NodeConverter::makeGroup},
        {"LayerSet", &NodeConverter::convertLayerSet},
        {"PhysicalMaterial", &NodeConverter::convertPhysicalMaterial},
        {"PickableGroup", &NodeConverter::makeGroup},
        {"Shape", &NodeConverter::convertShape},
        {"Texture", &NodeConverter::convertTexture},
        {"TwoSidedMaterial", &NodeConverter::convertTwoSidedMaterial},
        {"ViewpointGroup", &NodeConverter::makeGroup},
    };
    if (const auto found = conversions.find(element.name()); found != conversions.end())
      (this->*found->second)(element);
  }

  void rename(pugi::xml_node element, const char* name) {
    ++result_.converted[fmt::format("{} as {}", element.name(), name)];
    renameSilently(element, name);
  }

  static void renameSilently(pugi::xml_node element, const char* name) {
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
        elements_.offsets.add(hidden, elements_.offsets.of(child));
        hidden.append_move(child);
      }
    }
  }

  /// Pages draw all layers with one camera: those that `order` names as groups, the others hidden. A layer binds its
  /// own viewpoints and backgrounds, so that those of layers that are not active would turn up in the scene.
  void convertLayerSet(pugi::xml_node set) {
    static constexpr std::array bound{
        "Background"sv,        "Fog"sv,       "GeoViewpoint"sv,  "NavigationInfo"sv, "OrthoViewpoint"sv,
        "TextureBackground"sv, "Viewpoint"sv, "ViewpointGroup"sv};
    const std::vector<double> order = numbersOf(set, "order", {0});
    const double activeLayer = numbersOf(set, "activeLayer", {0})[0];
    rename(set, "Group");
    set.remove_attribute("order");
    set.remove_attribute("activeLayer");
    double number = 0;
    for (const pugi::xml_node& layer : elementsOf(set)) {
      if (std::string_view(layer.name()) != "Layer" && std::string_view(layer.name()) != "LayoutLayer")
        continue;
      ++number; // 0 is the scene itself
      if (std::ranges::find(order, number) == order.end()) {
        ++result_.hidden[layer.name()];
        setField(layer, "visible", "false");
      }
      if (number != activeLayer)
        for (const pugi::xml_node& element : descendantsOf(layer))
          if (isOneOf(bound, element.name())) {
            ++result_.unbound[element.name()];
            takeOut(element);
          }
    }
  }

  static std::vector<pugi::xml_node> descendantsOf(pugi::xml_node parent) {
    std::vector<pugi::xml_node> elements = elementsOf(parent);
    for (std::size_t i = 0; i < elements.size(); ++i)
      std::ranges::copy(elementsOf(elements[i]), std::back_inserter(elements));
    return elements;
  }

  /// A humanoid lists the nodes of its skeleton again, and holds the points of its skin, which are no nodes of the
  /// scene. Shapes of a skin whose points follow joints are in a Group of their own (x3d/skins.h).
  void convertHumanoid(pugi::xml_node humanoid) {
    static constexpr std::array lists{"joints"sv,
                                      "segments"sv,
                                      "sites"sv,
                                      "skinCoord"sv,
                                      "skinNormal"sv,
                                      "skinBindingCoords"sv,
                                      "skinBindingNormals"sv};
    const bool hasSkin = readSkin(humanoid, definitions(), elements_.skins);
    for (const pugi::xml_node& child : elementsOf(humanoid))
      if (isOneOf(lists, child.attribute("containerField").value()) || isList(child))
        takeOut(child);
    if (hasSkin)
      renameSilently(humanoid, "Transform");
    else
      makeTransform(humanoid);
  }

  /// Joints of skins are written as HAnimJoints again.
  void convertJoint(pugi::xml_node joint) {
    if (joint.attribute("USE") || elements_.skins.joints.contains(joint.internal_object()))
      renameSilently(joint, "Transform");
    else
      makeTransform(joint);
  }

  /// The elements with a DEF, for skins.
  Definitions& definitions() {
    if (definitionsOfSkins_.empty())
      for (const pugi::xml_node& element : descendantsOf(elements_.root()))
        if (const pugi::xml_attribute def = element.attribute("DEF"))
          definitionsOfSkins_.emplace(def.value(), element);
    return definitionsOfSkins_;
  }

  void convertSegment(pugi::xml_node segment) {
    for (const pugi::xml_node& child : elementsOf(segment))
      if (isList(child))
        takeOut(child);
    makeGroup(segment);
  }

  /// Whether an element is a list of values, which cannot be a child of a group.
  static bool isList(pugi::xml_node element) {
    static constexpr std::array lists{"Coordinate"sv, "Normal"sv};
    return isOneOf(lists, element.name());
  }

  /// X3DOM's ImageTexture under another name, whose image may also be an <img> in it.
  void convertTexture(pugi::xml_node texture) {
    if (std::string_view(texture.parent().name()) != "ImageGeometry") // whose images become patches
      ++result_.converted["Texture as ImageTexture"];
    texture.set_name("ImageTexture"); // its containerField stays
    if (const pugi::xml_node image = texture.child("img"); image && !texture.attribute("url"))
      texture.append_attribute("url") = image.attribute("src").value();
    texture.remove_child("img");
  }

  void convertTwoSidedMaterial(pugi::xml_node material) {
    rename(material, "Material");
    for (const char* field : {"separateBackColor", "backAmbientIntensity", "backDiffuseColor", "backEmissiveColor",
                              "backShininess", "backSpecularColor", "backTransparency"})
      material.remove_attribute(field);
  }

  void convertShape(pugi::xml_node shape) {
    if (convertUnlitGeometry(shape, definitions_, [this](pugi::xml_node element) { takeOut(element); }))
      ++result_.converted["Material of a geometry with lit=false as UnlitMaterial"];
  }

  void convertSurfaceShader(pugi::xml_node shader) { surfaceShaders_.convert(shader); }

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
  ShapeDefinitions definitions_;
  Definitions definitionsOfSkins_;
  pugi::xml_node takenOut_;
  bool hasVisiblePerChild_ = false;
  NodeConversions result_;
  SurfaceShaders surfaceShaders_;
};

} // namespace

NodeConversions convertNodes(Elements& elements) {
  return NodeConverter(elements).run();
}

} // namespace imgeo::x3d
