#pragma once
// X3DOM's `lit="false"` of geometry in files, as an UnlitMaterial (docs/formats/nodes.md).

#include "import/x3d/node_conversions.h"

#include <functional>
#include <map>
#include <pugixml.hpp>
#include <string>

namespace imgeo::x3d {

/// The geometries in files, Appearances and materials of a document, by DEF name.
using ShapeDefinitions = std::map<std::string, pugi::xml_node, std::less<>>;
ShapeDefinitions shapeDefinitionsOf(pugi::xml_node root);

/// Gives a Shape whose geometry has triangles that are not lit an Appearance of its own with an UnlitMaterial: in the
/// colours of the texture, else those of the vertices, else the material's emissiveColor. Points and lines are unlit in
/// any case. `takeOut` moves an element out of the scene. Returns whether the Shape is such a one.
bool convertUnlitGeometry(pugi::xml_node shape, const ShapeDefinitions& definitions,
                          const std::function<void(pugi::xml_node)>& takeOut);

} // namespace imgeo::x3d
