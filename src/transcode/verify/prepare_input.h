#pragma once
// Reads and prepares the input of a comparison as convert() did for the site.

#include "import/import.h"
#include "transcode/site/site_manifest.h"
#include "transcode/source/recordings.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace imgeo {

/// The input, prepared. For a site of another program normals are not computed. `recordings` gets what convert()
/// recorded. Throws Error for the input.
Imported preparedInput(const std::filesystem::path& input, const std::optional<SiteManifest>& manifest, bool outside,
                       std::vector<Recording>& recordings);

} // namespace imgeo
