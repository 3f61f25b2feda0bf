#pragma once
// Reads and prepares the input of a comparison as convert() did for the site.

#include "import/import.h"
#include "transcode/site/site_manifest.h"
#include "transcode/source/recordings.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace imgeo {

/// How convert() read the input of a site, of which another program wrote the one without `manifest`. `outside`: see
/// VerifyOptions.
ImportOptions importOptionsFor(const std::optional<SiteManifest>& manifest, bool outside);

/// Prepares a scene that was read as convert() did for the site. Throws Error{malformed} with `location` where it has
/// no elements.
void prepareAs(const SiteManifest& manifest, Scene& scene, const std::string& location);

/// The input, prepared. For a site of another program normals are not computed. `recordings` gets what convert()
/// recorded. Throws Error for the input.
Imported preparedInput(const std::filesystem::path& input, const std::optional<SiteManifest>& manifest, bool outside,
                       std::vector<Recording>& recordings);

} // namespace imgeo
