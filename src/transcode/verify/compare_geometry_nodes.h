#pragma once
// Compares the geometry that the site's document has with that of the input, beside the meshes in files.

#include "documents/documents.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Adds a finding for each kind of geometry node of which the site has more or fewer than the input: geometry that
/// stays in documents (Box, IndexedFaceSet), and nodes with which other programs draw geometry (PopGeometry,
/// ExternalShape).
void compareGeometryNodes(const SceneDocument& site, const SceneGraph& input, Findings& findings);

} // namespace imgeo
