#pragma once
// Compares a mesh of the input with the geometry images into which it was resampled.

#include "containers/container_reader.h"
#include "imgeo/verify.h"
#include "scene/mesh.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Measures the distance between a mesh and a geometry that states it (surfaceDistance). More than stated is a finding.
void compareResampled(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                      VerifyReport& report, Findings& findings);

} // namespace imgeo
