#pragma once
// The nodes that a page needs and a source may lack: viewpoint, lights, background.

#include "documents/documents.h"

#include <string>
#include <vector>

namespace imgeo {

/// Adds a viewpoint that shows the whole scene, two lights and a background, each if the scene has none of its kind;
/// lights without intensity or colour do not count. A scene with lights of its own has no headlight, one without has
/// one. Added nodes precede the scene's own. Sets the centre of rotation of all viewpoints. Adds a warning if shapes
/// are too large, too small or too far away to be drawn.
void addDefaultNodes(SceneDocument& document, std::vector<std::string>& warnings);

} // namespace imgeo
