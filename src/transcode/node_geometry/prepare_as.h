#pragma once
// Reads and prepares meshes as convert() did for a site.

#include "import/import.h"
#include "transcode/site/site_manifest.h"

#include <optional>
#include <string>

namespace imgeo {

/// How convert() read the input of a site, of which another program wrote the one without `manifest`. `outside`: see
/// VerifyOptions.
ImportOptions importOptionsFor(const std::optional<SiteManifest>& manifest, bool outside);

/// Prepares a scene that was read as convert() did for the site. Throws Error{malformed} with `location` where it has
/// no elements.
void prepareAs(const SiteManifest& manifest, Scene& scene, const std::string& location);

} // namespace imgeo
