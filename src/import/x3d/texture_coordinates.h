#pragma once
// The nodes of texture coordinates that a geometry node can have (ISO/IEC 19775-1, 18.4).

#include "imgeo/preparation.h"
#include "import/x3d/faces.h"
#include "import/x3d/source.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// The nodes of all sets of texture coordinates, in the order of channels: the children of a MultiTextureCoordinate, or
/// the single node; USEs resolved. Each is a TextureCoordinate or a TextureCoordinateGenerator.
std::vector<pugi::xml_node> texCoordNodes(const Source& source, pugi::xml_node geometry);

/// Adds the `mapping` of every texture of the document to the names of sets of texture coordinates that are kept: the
/// values of materials' fields such as normalTextureMapping.
void addTextureMappings(const Source& source, AttributeChoice& kept);

/// How a TextureCoordinateGenerator computes texture coordinates from vertices.
enum class TexCoordMode : std::uint8_t {
  coord,      ///< x and y of the position
  sphereLocal ///< x and y of the normal, from -1 .. 1 to 0 .. 1
};

struct TexCoordGenerator {
  TexCoordMode mode = TexCoordMode::coord;
  /// The node's mode where `mode` is not the same: one that depends on the camera, or on noise; else empty.
  std::string approximated;
};

/// Empty for other nodes. web/src/tessellate/texCoordModes.ts has the same table.
std::optional<TexCoordGenerator> texCoordGeneratorOf(pugi::xml_node node);

/// Gives each corner the texture coordinates that faces without any have (13.3.6): s grows from 0 to 1 along the
/// longest edge of the box of all positions, t along the next one at the same scale. withDefaultTexCoords in
/// web/src/tessellate gives the same; vectors/tessellation/geometryNodes.json tests both.
void addDefaultTexCoords(VertexData& data, Faces& faces);

/// Gives each corner texture coordinates of this mode. Computes smooth normals if the mode needs normals and there are
/// none; lines and points, which have no normals, then get no texture coordinates.
/// vectors/tessellation/geometryNodes.json tests this and withGeneratedTexCoords in web/src/tessellate.
void addGeneratedTexCoords(TexCoordMode mode, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
