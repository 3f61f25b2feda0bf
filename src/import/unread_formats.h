#pragma once
#include <string_view>

namespace imgeo {

/// What one may do with a file in a format that no reader of imgeo reads: continues a sentence; empty where the
/// extension says nothing. `extension`: in lower case, with its dot.
std::string_view adviceForUnread(std::string_view extension);

/// The same for curved surfaces of CAD, whatever their format.
inline constexpr std::string_view adviceForCurvedSurfaces =
    "; imgeo does not read the curved surfaces of CAD: export triangles, as glTF, OBJ or STL";

} // namespace imgeo
