#pragma once
// Compares the skins and displacers of the site's document with those of the input.

#include "documents/documents.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Adds a finding where skins or displacers differ in number, and one for all of a kind that differ.
void compareSkins(const SceneGraph& site, const SceneGraph& input, Findings& findings);

} // namespace imgeo
