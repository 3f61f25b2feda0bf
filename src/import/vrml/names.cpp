#include "import/vrml/names.h"

#include <map>
#include <set>

namespace imgeo::x3d {

std::string_view defaultContainerField(std::string_view element) {
  static const std::map<std::string_view, std::string_view> fields{{"Appearance", "appearance"},
                                                                   {"Arc2D", "geometry"},
                                                                   {"ArcClose2D", "geometry"},
                                                                   {"AudioClip", "source"},
                                                                   {"Box", "geometry"},
                                                                   {"Circle2D", "geometry"},
                                                                   {"Color", "color"},
                                                                   {"ColorRGBA", "color"},
                                                                   {"Cone", "geometry"},
                                                                   {"Coordinate", "coord"},
                                                                   {"CoordinateDouble", "coord"},
                                                                   {"Cylinder", "geometry"},
                                                                   {"Disk2D", "geometry"},
                                                                   {"ElevationGrid", "geometry"},
                                                                   {"Extrusion", "geometry"},
                                                                   {"FillProperties", "fillProperties"},
                                                                   {"FloatVertexAttribute", "attrib"},
                                                                   {"FogCoordinate", "fogCoord"},
                                                                   {"FontStyle", "fontStyle"},
                                                                   {"GeoCoordinate", "coord"},
                                                                   {"GeoElevationGrid", "geometry"},
                                                                   {"GeoOrigin", "geoOrigin"},
                                                                   {"ImageTexture", "texture"},
                                                                   {"IndexedFaceSet", "geometry"},
                                                                   {"IndexedLineSet", "geometry"},
                                                                   {"IndexedQuadSet", "geometry"},
                                                                   {"IndexedTriangleFanSet", "geometry"},
                                                                   {"IndexedTriangleSet", "geometry"},
                                                                   {"IndexedTriangleStripSet", "geometry"},
                                                                   {"LineProperties", "lineProperties"},
                                                                   {"LineSet", "geometry"},
                                                                   {"Material", "material"},
                                                                   {"MetadataBoolean", "metadata"},
                                                                   {"MetadataDouble", "metadata"},
                                                                   {"MetadataFloat", "metadata"},
                                                                   {"MetadataInteger", "metadata"},
                                                                   {"MetadataSet", "metadata"},
                                                                   {"MetadataString", "metadata"},
                                                                   {"MovieTexture", "texture"},
                                                                   {"MultiTexture", "texture"},
                                                                   {"MultiTextureCoordinate", "texCoord"},
                                                                   {"MultiTextureTransform", "textureTransform"},
                                                                   {"Normal", "normal"},
                                                                   {"NurbsCurve", "geometry"},
                                                                   {"NurbsPatchSurface", "geometry"},
                                                                   {"PhysicalMaterial", "material"},
                                                                   {"PixelTexture", "texture"},
                                                                   {"PointProperties", "pointProperties"},
                                                                   {"PointSet", "geometry"},
                                                                   {"Polyline2D", "geometry"},
                                                                   {"Polypoint2D", "geometry"},
                                                                   {"QuadSet", "geometry"},
                                                                   {"Rectangle2D", "geometry"},
                                                                   {"ScreenFontStyle", "fontStyle"},
                                                                   {"Sphere", "geometry"},
                                                                   {"Text", "geometry"},
                                                                   {"TextureCoordinate", "texCoord"},
                                                                   {"TextureCoordinate3D", "texCoord"},
                                                                   {"TextureCoordinate4D", "texCoord"},
                                                                   {"TextureCoordinateGenerator", "texCoord"},
                                                                   {"TextureProperties", "textureProperties"},
                                                                   {"TextureTransform", "textureTransform"},
                                                                   {"TriangleFanSet", "geometry"},
                                                                   {"TriangleSet", "geometry"},
                                                                   {"TriangleSet2D", "geometry"},
                                                                   {"TriangleStripSet", "geometry"},
                                                                   {"TwoSidedMaterial", "material"},
                                                                   {"UnlitMaterial", "material"}};
  const auto found = fields.find(element);
  return found == fields.end() ? "children" : found->second;
}

std::string_view currentFieldName(std::string_view element, std::string_view field) {
  if ((element == "LOD" && field == "level") || (element == "Switch" && field == "choice"))
    return "children";
  if (element == "Collision" && field == "collide")
    return "enabled";
  return field;
}

bool isStringList(std::string_view element, std::string_view field) {
  static const std::set<std::string_view> lists{"backUrl",        "bottomUrl", "family",  "frontUrl", "function",
                                                "geoSystem",      "info",      "justify", "leftUrl",  "objectType",
                                                "parameter",      "rightUrl",  "source",  "string",   "topUrl",
                                                "transitionType", "url"};
  return lists.contains(field) || (element == "NavigationInfo" && field == "type") ||
         (element == "MetadataString" && field == "value") || (element == "MultiTexture" && field == "mode");
}

bool isNodeList(std::string_view field) {
  static const std::set<std::string_view> lists{"addChildren",    "attrib",  "children", "choice",  "level",
                                                "removeChildren", "shaders", "skin",     "texture", "viewpoints"};
  return lists.contains(field);
}

std::string_view accessTypeOf(std::string_view word) {
  static const std::map<std::string_view, std::string_view> types{
      {"eventIn", "inputOnly"},        {"inputOnly", "inputOnly"},    {"eventOut", "outputOnly"},
      {"outputOnly", "outputOnly"},    {"field", "initializeOnly"},   {"initializeOnly", "initializeOnly"},
      {"exposedField", "inputOutput"}, {"inputOutput", "inputOutput"}};
  const auto found = types.find(word);
  return found == types.end() ? "" : found->second;
}

bool declaresFields(std::string_view element) {
  return element == "Script" || element == "ComposedShader" || element == "PackagedShader" ||
         element == "ShaderProgram";
}

} // namespace imgeo::x3d
