#pragma once
// Compares a mesh of the input with the geometry of the site that was made from it.

#include "containers/container_reader.h"
#include "scene/mesh.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/findings.h"

#include <optional>

namespace imgeo {

/// Decodes the geometry and compares boxes, base mesh, positions, elements and attributes. `mesh` is prepared as
/// convert does it. Without `manifest` another program wrote the site. Adds counts and errors to `report`.
void compareMesh(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                 const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings);

} // namespace imgeo
