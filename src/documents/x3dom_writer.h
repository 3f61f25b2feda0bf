#pragma once
// Writes the <X3D> element for X3DOM, which has no GeometryPatch node and reads SIG in releases 1.4 to 1.7 and BG in
// all releases. The requirements and their reasons are in docs/formats/x3dom.md.

#include "documents/scene_writer.h"

namespace imgeo {

/// The element with all its children, indented by `level` levels, ending in a newline. A shape of several patches
/// becomes a Group, which has its DEF, with one Shape for each patch; these share one Appearance. The containers must
/// have been encoded for X3DOM.
std::string x3domElement(const SceneDocument& document, std::size_t level, DocumentKind kind,
                         std::optional<std::size_t> inlineNode = {});

} // namespace imgeo
