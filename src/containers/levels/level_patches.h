#pragma once
// The groups of a level as the patches of a geometry, so that all code that reads patches reads levels, too.

#include "containers/patch_reader.h"

#include <string>
#include <utility>
#include <vector>

namespace imgeo {

/// Reads the index of a geometry that has levels, and makes the groups of level 0 its patches. Safe for untrusted
/// bytes. Throws Error naming the url; {malformed} also where the index has other position bits or elements than the
/// node.
void readLevels(GeometryDescription& geometry, const FetchFile& fetch);

/// Makes the groups of a level below levelCount() the patches of a geometry whose index has been read: of points above
/// level 0 their segments, for which it reads the files. Throws Error naming the url.
void choosePatchesOfLevel(GeometryDescription& geometry, std::uint32_t level, const FetchFile& fetch);

/// The files of levels and their roles: the pages of the index, groups of level 0 as patches, the others as bases.
std::vector<std::pair<std::string, Role>> filesOfLevels(const LevelsDescription& levels);

} // namespace imgeo
