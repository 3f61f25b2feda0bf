#include "import/vrml1/node_types.h"

#include <algorithm>
#include <map>
#include <vector>

namespace imgeo::vrml1 {

namespace {

using Fields = std::vector<std::string_view>;

const std::map<std::string_view, Fields>& nodeTypes() {
  static const std::map<std::string_view, Fields> types{
      {"AsciiText", {"string", "spacing", "justification", "width"}},
      {"Cone", {"parts", "bottomRadius", "height"}},
      {"Coordinate3", {"point"}},
      {"Cube", {"width", "height", "depth"}},
      {"Cylinder", {"parts", "radius", "height"}},
      {"DirectionalLight", {"on", "intensity", "color", "direction"}},
      {"FontStyle", {"size", "family", "style"}},
      {"Group", {}},
      {"IndexedFaceSet", {"coordIndex", "materialIndex", "normalIndex", "textureCoordIndex"}},
      {"IndexedLineSet", {"coordIndex", "materialIndex", "normalIndex", "textureCoordIndex"}},
      {"Info", {"string"}},
      {"LOD", {"range", "center"}},
      {"Material", {"ambientColor", "diffuseColor", "specularColor", "emissiveColor", "shininess", "transparency"}},
      {"MaterialBinding", {"value"}},
      {"MatrixTransform", {"matrix"}},
      {"Normal", {"vector"}},
      {"NormalBinding", {"value"}},
      {"OrthographicCamera", {"position", "orientation", "focalDistance", "height", "nearDistance", "farDistance"}},
      {"PerspectiveCamera", {"position", "orientation", "focalDistance", "heightAngle", "nearDistance", "farDistance"}},
      {"PointLight", {"on", "intensity", "color", "location"}},
      {"PointSet", {"startIndex", "numPoints"}},
      {"Rotation", {"rotation"}},
      {"Scale", {"scaleFactor"}},
      {"Separator", {"renderCulling"}},
      {"ShapeHints", {"vertexOrdering", "shapeType", "faceType", "creaseAngle"}},
      {"Sphere", {"radius"}},
      {"SpotLight", {"on", "intensity", "color", "location", "direction", "dropOffRate", "cutOffAngle"}},
      {"Switch", {"whichChild"}},
      {"Texture2", {"filename", "image", "wrapS", "wrapT"}},
      {"Texture2Transform", {"translation", "rotation", "scaleFactor", "center"}},
      {"TextureCoordinate2", {"point"}},
      {"Transform", {"translation", "rotation", "scaleFactor", "scaleOrientation", "center"}},
      {"TransformSeparator", {}},
      {"Translation", {"translation"}},
      {"WWWAnchor", {"name", "description", "map"}},
      {"WWWInline", {"name", "bboxSize", "bboxCenter"}}};
  return types;
}

} // namespace

bool isNodeType(std::string_view type) {
  return nodeTypes().contains(type);
}

bool hasField(std::string_view type, std::string_view field) {
  const auto found = nodeTypes().find(type);
  return found != nodeTypes().end() && std::ranges::find(found->second, field) != found->second.end();
}

bool isShape(std::string_view type) {
  return type == "AsciiText" || type == "Cone" || type == "Cube" || type == "Cylinder" || type == "IndexedFaceSet" ||
         type == "IndexedLineSet" || type == "PointSet" || type == "Sphere";
}

bool isLight(std::string_view type) {
  return type == "DirectionalLight" || type == "PointLight" || type == "SpotLight";
}

bool isCamera(std::string_view type) {
  return type == "OrthographicCamera" || type == "PerspectiveCamera";
}

bool restoresState(std::string_view type) {
  return type == "Separator" || type == "WWWAnchor" || type == "LOD" || !isNodeType(type);
}

} // namespace imgeo::vrml1
