#pragma once
// Compares a mesh of the input with the geometry images into which it was resampled.

#include "containers/container_reader.h"
#include "imgeo/verify.h"
#include "scene/mesh.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/findings.h"

#include <optional>

namespace imgeo {

/// Measures the distance between a mesh and a geometry that states it (surfaceDistance). More than stated is a finding,
/// and so are vertices whose attributes differ from those of the mesh, where they were sampled, by more than their
/// rounding.
void compareResampled(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                      const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings);

} // namespace imgeo
