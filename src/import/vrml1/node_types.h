#pragma once
// The 36 node types of VRML 1.0 with their fields.

#include <string_view>

namespace imgeo::vrml1 {

bool isNodeType(std::string_view type);
/// False for a type that is none of VRML 1.0.
bool hasField(std::string_view type, std::string_view field);

bool isShape(std::string_view type);
bool isLight(std::string_view type);
bool isCamera(std::string_view type);
/// Whether the state after a node of this type is the state before it: its lights shine on its children only.
bool restoresState(std::string_view type);

} // namespace imgeo::vrml1
