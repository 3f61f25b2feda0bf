#pragma once
// Web pages that hold an X3D scene: HTML, by the rules of HTML5, and XHTML. The first <x3d> element is read as an X3D
// document is; element and field names may be in any case. Nothing else of the page is carried over, but its title
// where the scene has none.

#include "import/import.h"

#include <pugixml.hpp>

namespace imgeo {

/// True where the text begins with `<!doctype html>` or `<html>`, after comments, instructions and white space.
bool isPage(ByteSpan bytes);
Imported readPage(ByteSpan bytes, const std::string& name, const ImportOptions& options);

namespace x3d {

/// Gives elements and attributes, whose letters may be in another case, the names that X3D documents have.
void nameAsInX3d(pugi::xml_document& document);

} // namespace x3d

} // namespace imgeo
