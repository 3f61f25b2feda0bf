#pragma once
// The browser's half of imgeo, carried inside the tool: every site gets a copy.

#include <string_view>

namespace imgeo {

/// The bundled ES module (web/dist/imgeo.js) as it was when the tool was built.
std::string_view runtimeModule();

} // namespace imgeo
