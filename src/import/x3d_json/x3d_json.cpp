#include "import/x3d_json/x3d_json.h"

#include "import/x3d/x3d.h"
#include "import/x3d_json/parser.h"

namespace imgeo {

bool isX3dJson(ByteSpan bytes) {
  std::string_view text = asText(bytes).substr(0, 4096);
  const auto takeAfterSpace = [&](std::string_view token) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const bool found = text.starts_with(token);
    text.remove_prefix(found ? token.size() : 0);
    return found;
  };
  return takeAfterSpace("{") && takeAfterSpace("\"X3D\"");
}

Imported readX3dJson(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return x3d::readElements(x3d::parseX3dJson(asText(bytes), name), bytes, name, options);
}

} // namespace imgeo
