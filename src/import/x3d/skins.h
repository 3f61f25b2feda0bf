#pragma once
// HAnim's skins (ISO/IEC 19774-1): the shapes in the `skin` of an HAnimHumanoid, whose points follow the joints that
// name them (HAnimJoint.skinCoordIndex and skinCoordWeight).

#include "markup/x3d_element.h"
#include "scene/skin.h"
#include "scene/vertex_attributes.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// The joints of a skin, with the members of Humanoid.
struct Skin {
  std::vector<std::string> joints; ///< DEFs
  std::vector<Affine3d> inverseBindings;
};

/// What is wrong with an element, with its name but without its location.
struct SkinFault {
  pugi::xml_node element;
  std::string message;
};

/// The skins of a document.
struct Skins {
  /// By the Group with the shapes of a skin.
  std::map<pugi::xml_node_struct*, Skin> groups;
  /// By geometry element: joints and their weights for each of its points.
  std::map<pugi::xml_node_struct*, std::vector<NamedAttribute>> pointAttributes;
  std::set<pugi::xml_node_struct*> joints; ///< of all skins
  std::vector<SkinFault> faults;
};

/// The first element with each DEF of a document.
using Definitions = std::map<std::string, pugi::xml_node, std::less<>>;

/// Reads the skin of an HAnimHumanoid, if it has one: moves its shapes into a Group behind the skeleton, and gives a
/// DEF to joints that have none. Points whose weights sum up to less than one rest with the remainder, at a joint that
/// is added. Indices and weights that are wrong have no effect, with a fault for each joint. `definitions`: of the
/// document; DEFs that joints get are added. Returns whether there is a skin.
bool readSkin(pugi::xml_node humanoid, Definitions& definitions, Skins& skins);

} // namespace imgeo::x3d
