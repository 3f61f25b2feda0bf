#pragma once
// Checks the levels of detail of a point cloud against one another.

#include "containers/patch_reader.h"
#include "transcode/verify/findings.h"

#include <filesystem>

namespace imgeo {

/// Reads all groups and checks that the points of each child in its parent are points of the child, with all their
/// attributes, and that no point of level 0 below a group is farther from the nearest point of its coarse form than the
/// index states. Reading has checked that errors and spheres nest. Memory holds the index, a few groups and, unless a
/// folder `scratch` is stated on whose disk they are, the positions of all points of level 0 (12 bytes each). Throws
/// Error for files that cannot be read, WorkFault where that disk has no room.
void checkPointLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings,
                      const std::filesystem::path& scratch = {});

} // namespace imgeo
