#pragma once
// Encodes a mesh as geometry images: convert --as geometry-image.

#include "transcode/encode/encode_mesh.h"

#include <optional>

namespace imgeo {

/// Resamples a mesh of triangles on grids, one for each chart of its surface, and writes them as an ImageGeometry of
/// SIG classic. EncodedMesh::resampled has the distance of the written surface from that of the mesh. Nothing for a
/// mesh without triangles of some area, which stays a mesh. Deterministic.
///
/// Throws Error{usage} if the options' grid has too few texels for the charts, or no grid keeps their maximum error.
std::optional<EncodedMesh> encodeGeometryImages(const Mesh& mesh, const ConvertOptions& options, ContentFiles& files);

} // namespace imgeo
