#pragma once
// CommonSurfaceShader, the material of X3DOM and InstantReality, as a Material or, where it asks for reflections or
// transmission, as a PhysicalMaterial (docs/formats/nodes.md, "CommonSurfaceShader").

#include "import/x3d/node_conversions.h"

#include <functional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <utility>

namespace imgeo::x3d {

class SurfaceShaders {
public:
  /// `takeOut` moves an element out of the scene.
  SurfaceShaders(NodeConversions& result, std::function<void(pugi::xml_node)> takeOut)
      : result_(result), takeOut_(std::move(takeOut)) {}

  /// Turns the shader into a material, which replaces the materials beside it.
  void convert(pugi::xml_node shader);

private:
  void makeMaterial(pugi::xml_node shader);
  void makePhysicalMaterial(pugi::xml_node shader);
  void convertTextures(pugi::xml_node shader, bool isPhysical);
  void unwrapTexture(pugi::xml_node material, pugi::xml_node wrapper, const std::string& field);
  void removeOtherFields(pugi::xml_node shader);
  void noteLeftOut(const std::string& field);

  NodeConversions& result_;
  std::function<void(pugi::xml_node)> takeOut_;
  std::set<std::string> physicalDefs_; ///< DEF names of shaders that became a PhysicalMaterial
  std::size_t mappings_ = 0;           ///< the number in the last mapping that was invented
};

} // namespace imgeo::x3d
