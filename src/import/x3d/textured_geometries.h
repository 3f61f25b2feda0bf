#pragma once
// Which geometry nodes a document shows with a texture: those without texture coordinates have default ones then.

#include "markup/x3d_element.h"

#include <pugixml.hpp>
#include <set>

namespace imgeo::x3d {

/// The geometry nodes of Shapes whose Appearance has a texture of two dimensions, its own or that of its material. USEs
/// are resolved. Names are those of X3D.
std::set<pugi::xml_node_struct*> texturedGeometries(pugi::xml_node root, const ElementsByDef& defs);

} // namespace imgeo::x3d
