#pragma once
// Encodes a regular grid of heights as a height map: convert --as height-map.

#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// Writes a mesh that is a height field (prepare/height_field.h) as an ImageGeometry of mode heightMap, with images of
/// the high and the low bytes of 16-bit heights. Whole heights stay exact; others are spread over the 16 bits. Normals
/// are left out: pages compute them. A grid of more than options.gridImageEdge columns or rows has several patches,
/// which share columns and rows, with the normals of the mesh. Deterministic.
/// Throws Error{usage}, which names the option, for other meshes and for grids of more than 65,536 columns or rows.
EncodedMesh encodeHeightMap(const Mesh& mesh, const ConvertOptions& options, ContentFiles& files);

} // namespace imgeo
