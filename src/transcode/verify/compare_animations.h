#pragma once
// Compares the animations of the site's document with those of the input.

#include "documents/documents.h"
#include "imgeo/verify.h"
#include "import/import.h"
#include "transcode/site/site_manifest.h"

namespace imgeo {

/// Adds a finding where TimeSensors, interpolators or routes differ in number, and one for all of a kind that differ.
/// With a glTF file, a site of X3D is compared by compareGltfAnimations(), and any other must equal it in one of both
/// ways, with nothing that glTF cannot express.
void compareAnimations(const SceneDocument& site, const Imported& input, const SiteManifest& manifest,
                       VerifyReport& report);

} // namespace imgeo
