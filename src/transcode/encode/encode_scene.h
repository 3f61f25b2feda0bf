#pragma once
// Turns a prepared scene into its document and writes the geometry files.

#include "documents/documents.h"
#include "transcode/encode/encode_mesh.h"

namespace imgeo {

/// Encodes every mesh once, however many shapes use it, in the spatial order of the shapes, and writes its files. Adds
/// counts and errors to `report`. The scene has at least one shape, or is complete (an X3D source).
SceneDocument encodeScene(Scene&& scene, const ConvertOptions& options, ContentFiles& files, ConvertReport& report,
                          const ElementsDone& done);

} // namespace imgeo
