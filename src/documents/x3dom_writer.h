#pragma once
// The <X3D> element for X3DOM, which knows no GeometryPatch and reads each kind
// of container in other releases: SIG in 1.4 to 1.7, BG in all. What must be so
// and why: docs/formats/x3dom.md.

#include "documents/scene_writer.h"

namespace imgeo {

/// The element with all its children, indented by `level`, ending in a newline.
/// A shape of several patches becomes a Group, which takes its DEF, of as many
/// Shapes, which share its Appearance. The containers were encoded for X3DOM.
std::string x3domElement(const SceneDocument& document, std::size_t level, DocumentKind medium,
                         std::optional<std::size_t> inlineNode = {});

} // namespace imgeo
