#pragma once
// Sanitises X3D sources for HTML pages, in which <script>, on... attributes and javascript: urls would be executed. An
// allowlist has the elements of X3D; a denylist has the attributes on which browsers act.

#include <string>
#include <string_view>

namespace imgeo {

/// Whether an element is a node of X3D 4 (ISO/IEC 19775-1:2023) other than Script and prototypes.
bool isAllowedInPage(std::string_view element);

/// Whether browsers ignore an attribute of this name.
bool isInertAttribute(std::string_view attribute);

/// Whether a url is relative or of http(s), parsed as in a browser: spaces and control characters in the scheme are
/// ignored.
bool isSafeUrl(std::string_view url);

/// The safe urls of an MFString, as an MFString; "" if there are none.
std::string safeUrls(std::string_view text);

} // namespace imgeo
