#include "import/vrml/vrml.h"

#include "import/vrml/parser.h"
#include "import/vrml1/translator.h"
#include "import/x3d/x3d.h"

namespace imgeo {

bool isVrml(ByteSpan bytes) {
  return asText(bytes).starts_with("#VRML V") || asText(bytes).starts_with("#X3D V");
}

Imported readVrml(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const bool isVersion1 = asText(bytes).starts_with("#VRML V1");
  return x3d::readElements(isVersion1 ? vrml1::readVrml1(asText(bytes), name, options.strict)
                                      : x3d::parseVrml(asText(bytes), name),
                           bytes, name, options);
}

} // namespace imgeo
