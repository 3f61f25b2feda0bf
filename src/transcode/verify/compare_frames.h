#pragma once
// Compares the frames of a site's sequences with those that they were made from.

#include "imgeo/verify.h"
#include "transcode/site/sequences.h"
#include "transcode/source/recordings.h"
#include "transcode/verify/check_files.h"

namespace imgeo {

/// Adds the elements of a sequence to the report, and a finding for each frame that is not the source's. Throws Error
/// for a file of the site or a frame of the source that cannot be read.
void compareFrames(const SiteDocument& document, const SiteSequence& sequence, const FrameSource& source,
                   VerifyReport& report, Findings& findings);

/// The same for all sequences of a site, in the order of their shapes.
void compareRecordings(const SiteDocument& document, const std::vector<Recording>& recordings, VerifyReport& report,
                       Findings& findings);

} // namespace imgeo
