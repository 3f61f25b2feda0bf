#pragma once
// Compares the animations of the site's document with those of the input.

#include "documents/documents.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Adds a finding where TimeSensors, interpolators or routes differ in number, and one for all of a kind that differ.
void compareAnimations(const SceneDocument& site, const SceneGraph& input, Findings& findings);

} // namespace imgeo
