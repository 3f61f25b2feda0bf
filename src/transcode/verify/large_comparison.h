#pragma once
// Compares a source that memory does not hold with the site that was made of it: large meshes and clouds one after the
// other, region by region, the others as a whole, one by one where memory does not hold them together.

#include "containers/container_reader.h"
#include "transcode/out_of_core/mesh_files.h"
#include "transcode/verify/choose_comparison.h"
#include "transcode/verify/findings.h"
#include "transcode/verify/scattered_source.h"

#include <map>
#include <memory>
#include <utility>

namespace imgeo {

class LargeComparison {
public:
  /// Reads the meshes that are compared as a whole, or stores them, and of the large ones what is known of all of each.
  /// `options` and `manifest` are those of their import. Throws Error for the source and the work folder.
  LargeComparison(ChosenComparison chosen, const ImportOptions& options, const SiteManifest& manifest,
                  const std::filesystem::path& workFolder, std::uint64_t memory);

  /// The source, prepared as convert() does it, with a mesh of two vertices in place of each large one: see
  /// ScatteredSource.
  Imported takeInput() { return std::move(input_); }
  /// The meshes of the source that are on the disk; null: none.
  const StoredMeshes* stored() const { return stored_.get(); }

  /// Whether a mesh of the source is compared out of core.
  bool isLarge(std::size_t mesh) const { return sources_.contains(mesh); }
  /// As compareMesh() does. Throws Error for files of the site, WorkFault for the source and those of the work folder.
  void compare(std::size_t mesh, const ContainerReader& reader, const GeometryDescription& geometry,
               VerifyReport& report, Findings& findings);

private:
  void store(const std::set<std::size_t>& meshes);

  std::unique_ptr<ChunkedSource> source_;
  ImportOptions options_;
  SiteManifest manifest_;
  VerifyWork work_;
  std::map<std::size_t, ScatteredSource> sources_; ///< by mesh
  std::unique_ptr<MeshFiles> stored_;
  Imported input_;
};

} // namespace imgeo
