#pragma once
// Decodes a site's geometry files into a scene.

#include "scene/scene.h"
#include "transcode/site/site_document.h"

namespace imgeo {

/// Decodes every geometry of a document. The patches of a geometry become one mesh: equal lattice points become one
/// position, also across patch borders, and equal vertices one wedge. Degenerate triangles, which join strips, are
/// dropped. A shape that draws several kinds of elements becomes several (documents/mixed_geometries.h). Safe for
/// untrusted bytes. Throws Error; {malformed} if no file has something to draw.
Scene readMeshes(const SiteDocument& document);

} // namespace imgeo
