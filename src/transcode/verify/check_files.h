#pragma once
// Whether the files of a site are there and consistent.

#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Checks that every file that the document names is there and, unless another program wrote the site, that its name is
/// the hash of its content. Ignores textures that `input` lacks as well. Returns whether all files are there.
bool checkFiles(const SiteDocument& document, bool isForeign, const SceneGraph& input, Findings& findings);

/// Checks that the icon and the picture of the page are there and have the content that the manifest states.
void checkPictures(const SiteDocument& page, const SiteManifest& manifest, Findings& findings);

/// Checks that the page and scene.x3d hold the same scene; `isWhole`: with the geometry of their nodes, as
/// openWholeDocument() has opened the page.
void checkDocuments(const SiteDocument& page, bool isWhole, Findings& findings);

} // namespace imgeo
