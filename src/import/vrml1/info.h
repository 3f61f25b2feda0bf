#pragma once
// Info nodes of VRML 1.0: settings under names that browsers agreed on, and notes of authors.

#include "import/vrml/elements.h"
#include "import/vrml1/tree.h"

namespace imgeo::vrml1 {

/// Adds a Background for "DEF BackgroundColor Info", a NavigationInfo for "DEF Viewer Info", and a WorldInfo with the
/// title of "DEF Title Info" and the strings of all other Infos.
void addSceneInfo(const Tree& tree, x3d::VrmlElements& elements, pugi::xml_node scene);

/// The NavigationInfo of the scene, which is added where there is none.
pugi::xml_node navigationInfoOf(x3d::VrmlElements& elements, pugi::xml_node scene, const x3d::Token& where);

} // namespace imgeo::vrml1
