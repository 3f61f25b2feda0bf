#pragma once
// Whether a site is compared with its input out of core, and which of its meshes.

#include "import/chunks/chunked_source.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/verify_work.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <set>

namespace imgeo {

/// An input that is compared out of core. Where its shapes are not as many as the site's, none of its meshes is
/// compared.
struct ChosenComparison {
  std::unique_ptr<ChunkedSource> source;
  std::set<std::size_t> large;      ///< meshes that are compared out of core
  std::set<std::size_t> whole;      ///< the others, each of which is read
  bool storesWhole = false;         ///< whether these are on the disk, as memory does not hold them together
  std::uint64_t wholeBytes = 0;     ///< their memory, about, where it does
  std::uint64_t structureBytes = 0; ///< memory of what is known of each mesh, about
};

/// The input, if it is to be compared out of core: comparing it would take more memory than there is, or a work folder
/// is stated. Large are meshes and clouds with levels of detail in the site, each of which has been made of one mesh.
/// Throws Error{usage, unsupported} where options ask for that and it is not possible, with the reason.
std::optional<ChosenComparison> chooseComparison(const SiteDocument& document,
                                                 const std::optional<SiteManifest>& manifest,
                                                 const std::filesystem::path& site, const std::filesystem::path& input,
                                                 const VerifyOptions& options);

} // namespace imgeo
