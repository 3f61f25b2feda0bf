#pragma once
// What of a foreign X3D document may stand in an HTML page. A page runs what its
// elements say: <script>, on... attributes, urls of javascript:. So only elements
// that X3D names go there, and of their fields those that no browser acts on.

#include "scene/scene.h"

#include <map>
#include <string>
#include <string_view>

namespace imgeo {

/// Whether an element is a node of X3D 4 (ISO/IEC 19775-1:2023) that does nothing by
/// itself: all but Script and prototypes.
bool isAllowedInPage(std::string_view element);

/// Whether browsers do nothing by themselves about an attribute of this name.
bool isInertAttribute(std::string_view attribute);

/// Whether a url is relative or of http(s), as a browser reads it: blanks and control
/// characters before and inside of the scheme do not hide it.
bool isSafeUrl(std::string_view url);

/// The urls of an MFString that are such, as an MFString; "" where none is.
std::string safeUrls(std::string_view text);

/// How many nodes of each element a page of this scene lacks.
std::map<std::string, std::size_t> elementsLeftOutOfPage(const SceneGraph& graph);

} // namespace imgeo
