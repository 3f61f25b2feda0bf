#pragma once
// X3D in JSON encoding (ISO/IEC 19776-5): parsed into the elements of X3D's XML encoding, then read as X3D.

#include "import/import.h"

namespace imgeo {

/// True where the text is an object whose first key is "X3D".
bool isX3dJson(ByteSpan bytes);
Imported readX3dJson(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
