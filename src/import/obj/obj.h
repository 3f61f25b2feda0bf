#pragma once
// Wavefront OBJ and its MTL files: v (with colours), vt, vn, f, l, o, usemtl, mtllib. Each `o` is a shape, or two where
// it has faces and lines; `g` is ignored. Without faces and lines: a point cloud. Limit: 8 GiB.

#include "import/import.h"

namespace imgeo {

/// True where the first line that is neither blank nor a comment begins with a keyword of OBJ.
bool resemblesObj(ByteSpan bytes);
Imported readObj(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
