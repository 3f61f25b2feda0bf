#pragma once
// PLY (Stanford polygon format 1.0): ASCII and binary of both byte orders, every scalar type; vertices with x y z and,
// where present, nx ny nz, s t (u v, texture_u texture_v), red green blue alpha (diffuse_red ...); `face` with
// vertex_indices (vertex_index), texcoord and texnumber (textures.h); `tristrips`; `edge` with vertex1 and vertex2,
// which become a shape of lines. A file without faces, strips and edges is a point cloud. Other properties of a vertex
// are further attributes where the options ask for them (in single precision; they must be finite): NAME, or two to
// four consecutive NAME_0 .. NAME_3 as one attribute's components.

#include "import/import.h"

namespace imgeo {

/// True for bytes that begin with PLY's magic.
bool isPly(ByteSpan bytes);
Imported readPly(ByteSpan bytes, const std::string& name, const ImportOptions& options);
/// Reads a file of faces of one texture, which is left to the caller.
Imported readPlyWithoutTextures(ByteSpan bytes, const std::string& name, const ImportOptions& options);
/// Adds a warning if bytes stand behind the last element of a file.
void warnOfTrailingPlyBytes(std::vector<std::string>& warnings, std::uint64_t bytes);

} // namespace imgeo
