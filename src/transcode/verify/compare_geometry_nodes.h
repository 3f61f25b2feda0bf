#pragma once
// Compares the geometry that the site's documents have with that of the input, beside the meshes in files.

#include "transcode/site/site_document.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Compares geometry nodes that stay in documents (Box, IndexedFaceSet), and nodes with which other programs draw
/// geometry (PopGeometry, ExternalShape): of each kind their number, and the fields of each and of its children, in
/// the site's document, in scene.x3d beside a page of convert, and in documents that they inline. A finding names the
/// file, the line and the path of the first elements that differ.
void compareGeometryNodes(const SiteDocument& site, bool hasSceneFile, const SceneGraph& input, Findings& findings);

} // namespace imgeo
