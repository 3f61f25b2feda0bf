#pragma once
// Writes a scene to a mesh file and reports what the file contains.

#include "export/export.h"
#include "scene/scene.h"
#include "transcode/export/export_site.h"

namespace imgeo {

/// Writes the scene as a mesh file. The report counts every instance of a shape. Throws Error.
ExportReport writeScene(const Scene& scene, MeshFormat format, const std::filesystem::path& output);

} // namespace imgeo
