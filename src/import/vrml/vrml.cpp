#include "import/vrml/vrml.h"

#include "import/vrml/parser.h"
#include "import/x3d/x3d.h"

namespace imgeo {

bool isVrml(ByteSpan bytes) {
  return asText(bytes).starts_with("#VRML V") || asText(bytes).starts_with("#X3D V");
}

Imported readVrml(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return x3d::readElements(x3d::parseVrml(asText(bytes), name), bytes, name, options);
}

} // namespace imgeo
