#pragma once
// Compares a source that memory does not hold with the mesh or cloud of a site that was made of it, region by region.

#include "containers/container_reader.h"
#include "transcode/verify/findings.h"
#include "transcode/verify/scattered_source.h"

#include <memory>

namespace imgeo {

class LargeComparison {
public:
  /// Reads the source and divides it among regions. `geometry`: that of the site, which must outlive the object. Throws
  /// Error for the source and the work folder.
  LargeComparison(std::unique_ptr<ChunkedSource> source, const ImportOptions& options, const SiteManifest& manifest,
                  const GeometryDescription& geometry, const std::filesystem::path& workFolder, std::uint64_t memory);

  /// The source with a mesh of two vertices: see ScatteredSource.
  const Imported& extremes() const { return source_.extremes(); }

  /// As compareMesh() does. Throws Error for files of the site, WorkFault for those of the work folder.
  void compare(const ContainerReader& reader, const SiteManifest& manifest, VerifyReport& report,
               Findings& findings) const;

private:
  VerifyWork work_;
  ScatteredSource source_;
  const GeometryDescription& geometry_;
};

} // namespace imgeo
