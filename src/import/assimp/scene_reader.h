#pragma once
// Turns an aiScene into a scene: its nodes, with all that other files of this folder read.

#include "import/import.h"
#include "import/references.h"

#include <string>
#include <string_view>

struct aiScene;

namespace imgeo {

/// `name` of the file, for messages; `extension` of its format: in lower case, without its dot. Throws
/// Error{malformed, limit}.
Imported readAssimpScene(const aiScene& source, const std::string& name, const References& references,
                         const ImportOptions& options, std::string_view extension);

} // namespace imgeo
