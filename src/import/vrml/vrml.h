#pragma once
// VRML97, and X3D in classic VRML encoding: parsed into the elements of X3D's XML encoding, then read as X3D. VRML 1.0
// is translated into those elements by vrml1/.

#include "import/import.h"

namespace imgeo {

/// True for the header of VRML of any version, and of X3D in classic VRML encoding.
bool isVrml(ByteSpan bytes);
Imported readVrml(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
