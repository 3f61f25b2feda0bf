#pragma once
// The nodes that a page needs and a source may lack: viewpoints, lights, background.

#include "documents/documents.h"
#include "transcode/default_scene/start_view.h"

#include <string>
#include <vector>

namespace imgeo {

/// Adds viewpoints from several sides, two lights and a background, each if the scene has none of its kind; lights
/// without intensity or colour do not count. Where `view` names a side, a viewpoint there is the first one, also before
/// the scene's own. A scene with lights of its own has no headlight, one without has one. Added nodes precede the
/// scene's own. Sets the centre of rotation of all viewpoints. Adds a warning if shapes are too large, too small or too
/// far away to be drawn.
void addDefaultNodes(SceneDocument& document, StartView view, const ViewSamples& samples,
                     std::vector<std::string>& warnings);

/// Whether a scene has a viewpoint of its own.
bool hasViewpoint(const SceneGraph& graph);

} // namespace imgeo
