#pragma once
// export: Scene -> the bytes of a mesh file that other programs read. One file
// per format; this header is all that other folders see.

#include "base/bytes.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>

namespace imgeo {

enum class MeshFormat : std::uint8_t { ply, obj, glb };

/// "PLY", "OBJ", "GLB".
const char* nameOf(MeshFormat format);

/// The format that a file name's ending stands for, whatever its case.
std::optional<MeshFormat> meshFormatOf(const std::filesystem::path& file);

/// Writes a scene that shows at least one shape, whose meshes are consistent.
/// Coordinates are written so that they read back as the same floats.
/// Deterministic. Throws Error{limit} for more than the format can count.
Bytes exportScene(const Scene& scene, MeshFormat format);

/// PLY, binary little-endian: all shapes where the world has them as one mesh, since
/// PLY knows no objects.
/// Each wedge is a vertex with x y z, nx ny nz, s t, red green blue (alpha);
/// triangles are `face`, lines `edge` elements; the corners of points need none.
/// Further attributes are floats of their names, those of several components NAME_0, NAME_1 ....
/// Where only some shapes have an attribute, the others get (0, 0, 0) as
/// normals, (0, 0) as texture coordinates, their diffuse colour, and zeros.
Bytes writePly(const Scene& scene);

/// Wavefront OBJ: an `o` for each shape, where the world has it; a position is a
/// `v`, a wedge a `vt` and a `vn`. Colours follow the coordinates of `v`, as MeshLab writes and
/// most programs read them; a position whose wedges differ in colour is written
/// once a colour. Alpha and materials are left out.
Bytes writeObj(const Scene& scene);

/// Binary glTF 2.0: the scene's nodes below which something is seen, with their
/// transforms; a mesh that several shapes show is stored once. Each wedge is a vertex
/// with POSITION, NORMAL, TEXCOORD_0 (v measured down, as glTF has it), COLOR_0
/// (linear, 16 bits a channel) and, of further attributes, _NAME. Physical and unlit materials are kept;
/// others become rough dielectrics of their diffuse and emissive colour. Textures come along where their
/// image is at hand. Viewpoints become cameras, and lights come along but for those of lightsLeftOut.
Bytes writeGlb(const Scene& scene);

/// How many lights writeGlb leaves out: glTF's shine on everything and fall off by the
/// square of the distance.
std::size_t lightsLeftOut(const SceneGraph& graph);

} // namespace imgeo
