#pragma once
// Reads the nodes that hold the vertices of a geometry node: Coordinate, Normal, Color, TextureCoordinate and
// FogCoordinate.

#include "imgeo/preparation.h"
#include "import/x3d/faces.h"
#include "import/x3d/source.h"
#include "import/x3d/texture_coordinates.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace imgeo::x3d {

struct NodeVertexData {
  VertexData data;
  std::size_t furtherTexCoords = 0; ///< sets of texture coordinates that are left out
  std::optional<TexCoordGenerator> texCoordGenerator;
};

/// `kept`: see readGeometry. Throws Error{malformed} for invalid fields.
NodeVertexData readVertexData(const Source& source, pugi::xml_node geometry, const AttributeChoice& kept);

/// The numbers of a field that has `size` of them for each value. Throws Error{malformed} where some are missing.
std::vector<double> tuplesOf(const Source& source, pugi::xml_node from, const char* field, std::size_t size);

} // namespace imgeo::x3d
