#pragma once
// Turns a prepared scene into its document and writes the geometry files.

#include "documents/documents.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/source/recordings.h"

#include <span>

namespace imgeo {

/// Encodes every mesh once, however many shapes use it, in the spatial order of the shapes, and writes its files. Adds
/// counts and errors to `report`. The scene has at least one shape, or is complete (an X3D source). The meshes of
/// recordings become sequences with the options `ofSequences`, of SIG classic; `done` gets their frames.
SceneDocument encodeScene(Scene&& scene, const ConvertOptions& options, std::span<const Recording> recordings,
                          const ConvertOptions& ofSequences, ContentFiles& files, ConvertReport& report,
                          const ElementsDone& done);

} // namespace imgeo
