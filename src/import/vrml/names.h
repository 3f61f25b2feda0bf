#pragma once
// Facts about nodes and fields that the XML encoding needs and VRML syntax does not contain: default containerFields
// and the types of fields.

#include <string>
#include <string_view>

namespace imgeo::x3d {

/// The default containerField of an element (X3D DTD).
std::string_view defaultContainerField(std::string_view element);

/// X3D's name of a VRML97 field; the same name where it was not renamed.
std::string_view currentFieldName(std::string_view element, std::string_view field);

/// Whether a field is an MFString.
bool isStringList(std::string_view element, std::string_view field);

/// Whether a field is a list of nodes.
bool isNodeList(std::string_view field);

/// X3D's name of an access type of VRML97 or X3D; "" for other words.
std::string_view accessTypeOf(std::string_view word);

} // namespace imgeo::x3d
