#pragma once
// What VRML leaves unsaid and XML does not: which field a node stands in, and which
// strings are lists.

#include <string>
#include <string_view>

namespace imgeo::x3d {

/// The containerField that an element has where it says none (X3D's DTD).
std::string_view defaultContainerField(std::string_view element);

/// X3D's name of a field of VRML97 that was renamed since.
std::string_view currentFieldName(std::string_view element, std::string_view field);

/// Whether a field is an MFString, so that a single string is a list of one.
bool isStringList(std::string_view element, std::string_view field);

/// Whether a field is a list of nodes, of which an empty one says nothing.
bool isNodeList(std::string_view field);

/// X3D's name of an access type, for which VRML97 has another; "" for other words.
std::string_view accessTypeOf(std::string_view word);

/// Whether a node's author declares its fields himself.
bool declaresFields(std::string_view element);

} // namespace imgeo::x3d
