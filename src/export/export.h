#pragma once
// Writes a scene as a mesh file for other programs. There is one writer per format.

#include "base/bytes.h"
#include "imgeo/source_axes.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>

namespace imgeo {

enum class MeshFormat : std::uint8_t { ply, obj, glb };

/// "PLY", "OBJ", "GLB".
const char* nameOf(MeshFormat format);

/// The format that a file name's extension, in upper or lower case, names; nothing for other extensions.
std::optional<MeshFormat> meshFormatOf(const std::filesystem::path& file);

/// Writes a scene with at least one shape and consistent meshes. Coordinates read back as the same floats.
/// Deterministic. Throws Error{limit} if the scene is too large for the format.
Bytes exportScene(const Scene& scene, MeshFormat format);

/// PLY, binary little-endian: all shapes as one mesh in world coordinates, because PLY has no objects. Each wedge is a
/// vertex with x y z, nx ny nz, s t, red green blue (alpha); triangles are `face`, lines `edge` elements; points need
/// no elements. A comment "up y" states `up`, if any. Further attributes are float properties NAME or, for several
/// components, NAME_0, NAME_1 .... If only some shapes have an attribute, the others get (0, 0, 0) as normals, (0, 0)
/// as texture coordinates, their diffuse colour, and zeros.
Bytes writePly(const Scene& scene, std::optional<AxisDirection> up = {});

/// Wavefront OBJ: an `o` for each shape, in world coordinates; a position is a `v`, a wedge a `vt` and a `vn`. Colours
/// follow the coordinates of `v`, as MeshLab writes them. A position whose wedges have several colours has a `v` for
/// each. Alpha and materials are left out.
Bytes writeObj(const Scene& scene);

/// Binary glTF 2.0: the scene's nodes that have shapes, viewpoints or lights below them, with their transforms. A mesh
/// that several shapes use is stored once. Each wedge is a vertex with POSITION, NORMAL, TEXCOORD_0 (v points down in
/// glTF), COLOR_0 (linear, 16 bits per channel) and _NAME for each further attribute. Physical and unlit materials are
/// kept; others become rough dielectrics of their diffuse and emissive colour. Textures are written if their image is
/// available. Viewpoints become cameras. Lights are written except those that lightsLeftOut counts.
Bytes writeGlb(const Scene& scene);

/// Number of routes of a scene that writeGlb writes as animations.
std::size_t routesInGltf(const SceneGraph& graph);

/// Number of lights that writeGlb leaves out: lights of glTF are global and fall off with the square of the distance.
std::size_t lightsLeftOut(const SceneGraph& graph);

} // namespace imgeo
