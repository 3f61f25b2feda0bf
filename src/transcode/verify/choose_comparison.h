#pragma once
// Whether a site is compared with its input out of core.

#include "import/chunks/chunked_source.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/verify_work.h"

#include <memory>
#include <optional>

namespace imgeo {

/// The input, if it is to be compared out of core: that would take more memory than there is, or a work folder is
/// stated. Throws Error{usage, unsupported} where options ask for that and it is not possible, with the reason.
std::unique_ptr<ChunkedSource> chooseComparison(const SiteDocument& document,
                                                const std::optional<SiteManifest>& manifest,
                                                const std::filesystem::path& site, const std::filesystem::path& input,
                                                const VerifyOptions& options);

} // namespace imgeo
