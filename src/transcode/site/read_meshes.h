#pragma once
// A site's containers -> the scene that they hold.

#include "scene/scene.h"
#include "transcode/site/site_document.h"

namespace imgeo {

/// Decodes every shape of a document. A mesh's patches become one mesh again:
/// equal lattice points are one position, also across patch borders, and equal
/// records are one wedge. Triangles without area in the containers (strips are
/// joined by them) are left out. Safe for untrusted bytes; throws Error, also
/// {unsupported} for a shape that draws more than one kind of element, and
/// {malformed} where nothing is drawn at all.
Scene readMeshes(const SiteDocument& document);

} // namespace imgeo
