#pragma once
// A prepared scene -> its document, with everything that it refers to written.

#include "documents/documents.h"
#include "transcode/encode/encode_mesh.h"

namespace imgeo {

struct SiteContent {
  ContentFiles geometry, textures;
};

/// Encodes every mesh once, however many shapes show it, writes the images
/// of its textures, and gives a scene without
/// viewpoint, lights, background or materials those that show it well. Adds what
/// was written to `report`. The scene has at least one shape.
SceneDocument encodeScene(Scene&& scene, const ConvertOptions& options, SiteContent& content, ConvertReport& report,
                          const ElementsDone& done);

} // namespace imgeo
