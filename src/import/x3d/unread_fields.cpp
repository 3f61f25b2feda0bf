#include "import/x3d/unread_fields.h"

#include "import/x3d/field_values.h"
#include "import/x3d/summary.h"

#include <algorithm>
#include <array>
#include <map>

namespace imgeo::x3d {

namespace {

constexpr std::string_view noShadows = "pages draw no shadows", oneTexture = "of several textures the first is drawn",
                           fittedPlanes = "pages fit the near and far planes to the scene",
                           movedCamera = "binding a viewpoint always moves the camera to it",
                           oneMaterial = "the back of a surface has the material of its front",
                           noBorder = "textures have no border", twoNumbers = "texture coordinates have two components",
                           noTangents = "normal maps follow the texture coordinates",
                           openCuts = "cut surfaces are not closed", nothing = "";

constexpr auto unreadFieldTable = std::to_array<UnreadField>({
    {"Appearance", "backMaterial", "", oneMaterial},
    {"BinaryGeometry", "binormal", "", noTangents},
    {"BinaryGeometry", "binormalType", "Float32", noTangents},
    {"BinaryGeometry", "idsPerVertex", "false", "the parts of a MultiPart are not read"},
    {"BinaryGeometry", "numTexCoordComponents", "2", twoNumbers},
    {"BinaryGeometry", "tangent", "", noTangents},
    {"BinaryGeometry", "tangentType", "Float32", noTangents},
    {"ClipPlane", "cappingColor", "1 1 1", nothing},
    {"ClipPlane", "cappingStrength", "0", openCuts},
    {"ClipPlane", "on", "true", "enabled turns the plane off"},
    {"Collision", "description", "", nothing},
    {"Collision", "enabled", "true", nothing},
    {"ComposedCubeMapTexture", "description", "", nothing},
    {"DirectionalLight", "shadowIntensity", "1", nothing},
    {"DirectionalLight", "shadows", "false", noShadows},
    {"EnvironmentLight", "origin", "0 0 0", "the pictures of an EnvironmentLight are infinitely far away"},
    {"EnvironmentLight", "shadowIntensity", "1", nothing},
    {"EnvironmentLight", "shadows", "false", noShadows},
    {"FontStyle", "language", "", nothing},
    {"GeneratedCubeMapTexture", "description", "", nothing},
    {"ImageCubeMapTexture", "description", "", nothing},
    {"ImageGeometry", "numTexCoordComponents", "2", twoNumbers},
    {"ImageTexture", "colorSpaceConversion", "true", "images are always read as sRGB"},
    {"ImageTexture", "description", "", nothing},
    {"Inline", "description", "", nothing},
    {"Inline", "global", "false", nothing},
    {"LOD", "forceTransitions", "false", nothing},
    {"Layer", "objectType", "ALL", nothing},
    {"Layer", "pickable", "true", nothing},
    {"Layer", "pointerEvents", "true", nothing},
    {"MultiTexture", "alpha", "1", oneTexture},
    {"MultiTexture", "color", "1 1 1", oneTexture},
    {"MultiTexture", "description", "", nothing},
    {"MultiTexture", "function", "", oneTexture},
    {"MultiTexture", "mode", "", oneTexture},
    {"MultiTexture", "source", "", oneTexture},
    {"NavigationInfo", "visibilityLimit", "0", "pages draw as far as the scene reaches"},
    {"NurbsCurve", "tessellation", "0", nothing},
    {"NurbsCurve2D", "tessellation", "0", nothing},
    {"NurbsPatchSurface", "uTessellation", "0", nothing},
    {"NurbsPatchSurface", "vTessellation", "0", nothing},
    {"NurbsTrimmedSurface", "uTessellation", "0", nothing},
    {"NurbsTrimmedSurface", "vTessellation", "0", nothing},
    {"OrthoViewpoint", "farDistance", "-1", fittedPlanes},
    {"OrthoViewpoint", "jump", "true", movedCamera},
    {"OrthoViewpoint", "nearDistance", "-1", fittedPlanes},
    {"OrthoViewpoint", "retainUserOffsets", "false", movedCamera},
    {"OrthoViewpoint", "viewAll", "false", "viewpoints stand where they say"},
    {"PickableGroup", "description", "", nothing},
    {"PickableGroup", "objectType", "ALL", nothing},
    {"PickableGroup", "pickable", "true", nothing},
    {"PixelTexture", "description", "", nothing},
    {"PointLight", "shadowIntensity", "1", nothing},
    {"PointLight", "shadows", "false", noShadows},
    {"ProximitySensor", "description", "", nothing},
    {"Shape", "castShadow", "true", nothing},
    {"Shape", "pointerEvents", "true", nothing},
    {"SpecularMaterialExtension", "specularStrength", "1", "the field is read by glTF's name, specular"},
    {"SpotLight", "shadowIntensity", "1", nothing},
    {"SpotLight", "shadows", "false", noShadows},
    {"SquadOrientationInterpolator", "closed", "false", nothing},
    {"TextureCoordinateGenerator", "parameter", "", "each mode of texture coordinates has its default parameters"},
    {"TextureProperties", "borderColor", "0 0 0 0", noBorder},
    {"TextureProperties", "borderWidth", "0", noBorder},
    {"TextureProperties", "boundaryModeR", "REPEAT", nothing},
    {"TextureProperties", "textureCompression", "DEFAULT", nothing},
    {"TextureProperties", "texturePriority", "0", nothing},
    {"TimeSensor", "description", "", nothing},
    {"TwoSidedMaterial", "backAmbientIntensity", "0.2", nothing},
    {"TwoSidedMaterial", "backDiffuseColor", "0.8 0.8 0.8", nothing},
    {"TwoSidedMaterial", "backEmissiveColor", "0 0 0", nothing},
    {"TwoSidedMaterial", "backShininess", "0.2", nothing},
    {"TwoSidedMaterial", "backSpecularColor", "0 0 0", nothing},
    {"TwoSidedMaterial", "backTransparency", "0", nothing},
    {"TwoSidedMaterial", "separateBackColor", "false", oneMaterial},
    {"UnlitMaterial", "normalScale", "1", nothing},
    {"Viewpoint", "farDistance", "-1", fittedPlanes},
    {"Viewpoint", "jump", "true", movedCamera},
    {"Viewpoint", "nearDistance", "-1", fittedPlanes},
    {"Viewpoint", "retainUserOffsets", "false", movedCamera},
    {"Viewpoint", "viewAll", "false", "viewpoints stand where they say"},
    {"ViewpointGroup", "center", "0 0 0", nothing},
    {"ViewpointGroup", "description", "", nothing},
    {"ViewpointGroup", "displayed", "true", nothing},
    {"ViewpointGroup", "retainUserOffsets", "false", movedCamera},
    {"ViewpointGroup", "size", "0 0 0", nothing},
    {"VisibilitySensor", "description", "", nothing},
});

bool isBoolean(std::string_view text) {
  return parseBoolean(text, true) == parseBoolean(text, false);
}

/// Whether two texts are the same value: equal, or the same numbers or booleans.
bool isSameValue(std::string_view a, std::string_view b) {
  if (a == b)
    return true;
  if (isBoolean(a) && isBoolean(b))
    return parseBoolean(a, false) == parseBoolean(b, false);
  const auto numbers = parseReals(a), others = parseReals(b);
  return numbers && others && *numbers == *others;
}

/// An attribute's text without the quotes of a list of one string.
std::string_view unquoted(std::string_view text) {
  const std::string_view blanks = " \t\r\n\"";
  const std::size_t begin = text.find_first_not_of(blanks), end = text.find_last_not_of(blanks);
  return begin == text.npos ? "" : text.substr(begin, end - begin + 1);
}

class UnreadFieldWalker : public pugi::xml_tree_walker {
public:
  std::map<std::string_view, Summary::Counts> fields; ///< by reason

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element)
      return true;
    const auto [begin, end] = std::ranges::equal_range(unreadFieldTable, node.name(), {}, &UnreadField::node);
    for (const UnreadField& row : std::span(begin, end))
      if (!row.reason.empty() && isStated(node, row))
        ++fields[row.reason][std::string(row.node) + "." + std::string(row.field)];
    noteFurtherTextures(node);
    return true;
  }

private:
  static bool isStated(pugi::xml_node node, const UnreadField& row) {
    if (const pugi::xml_attribute value = node.attribute(row.field.data()))
      return !isSameValue(unquoted(value.value()), row.defaultText);
    return std::ranges::any_of(node.children(), [&](const pugi::xml_node& child) {
      return child.attribute("containerField").value() == row.field;
    });
  }

  /// The textures of a MultiTexture after its first.
  void noteFurtherTextures(pugi::xml_node node) {
    if (std::string_view(node.name()) != "MultiTexture")
      return;
    const auto textures = std::ranges::count_if(node.children(), [](const pugi::xml_node& child) {
      return std::string_view(child.name()).ends_with("Texture");
    });
    fields[oneTexture]["MultiTexture.texture"] += textures > 1;
  }
};

} // namespace

std::span<const UnreadField> unreadFields() {
  return unreadFieldTable;
}

void warnOfUnreadFields(const Elements& elements, std::vector<std::string>& warnings) {
  UnreadFieldWalker walker;
  elements.root().traverse(walker);
  for (auto& [reason, counts] : walker.fields) {
    std::erase_if(counts, [](const auto& count) { return count.second == 0; });
    warnOfElements(warnings, "Fields without effect, since " + std::string(reason), counts);
  }
}

} // namespace imgeo::x3d
