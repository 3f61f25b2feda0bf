#pragma once
// The triangles, or points, of a site's mesh with levels of detail, divided into the regions of its source.

#include "containers/container_reader.h"
#include "transcode/out_of_core/level_regions.h"
#include "transcode/verify/element_list.h"
#include "transcode/verify/mesh_checks.h"
#include "transcode/verify/verify_work.h"

#include <vector>

namespace imgeo {

class ScatteredSite {
public:
  /// Reads all groups of level 0. Throws Error for files of the site, {malformed} where groups have several sets of
  /// attributes. `reader`, `geometry` and `work` must outlive the object.
  ScatteredSite(const ContainerReader& reader, const GeometryDescription& geometry, const RegionTree& regions,
                const VerifyWork& work);

  /// The boxes of all groups.
  const BoxCheck& boxes() const { return boxes_; }
  /// The first group.
  const IndexedPatch& firstPatch() const { return first_; }
  /// The triangles or points of a region.
  ElementList elementsOf(std::uint32_t region) const;

private:
  void divideIntoTasks();
  /// Reads groups and writes their triangles, or points, by region.
  void scatter(std::size_t task, std::vector<Box3d>& boxes);

  const ContainerReader& reader_;
  const GeometryDescription& geometry_;
  const VerifyWork& work_;
  RegionedLevel level_;
  std::vector<std::size_t> ends_; ///< by task: the number of patches up to its last
  BoxCheck boxes_;
  IndexedPatch first_;
};

} // namespace imgeo
