#pragma once
// The nodes that a page needs and a source may lack: viewpoint, lights, background.

#include "documents/documents.h"

#include <string>
#include <vector>

namespace imgeo {

/// Adds a viewpoint that shows the whole scene, two lights and a background, each kind where the scene has none, before
/// the scene's own nodes, and sets the centre of rotation of all viewpoints. Adds a warning where shapes are too large
/// or too far away to be drawn.
void addDefaultNodes(SceneDocument& document, std::vector<std::string>& warnings);

} // namespace imgeo
