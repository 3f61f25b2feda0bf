#pragma once
// Checks the levels of detail of a point cloud against one another.

#include "containers/patch_reader.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Reads all groups and checks that the points of each child in its parent are points of the child, with all their
/// attributes, and that no point of level 0 below a group is farther from the nearest point of its coarse form than the
/// index states. Reading has checked that errors and spheres nest. Memory holds the index, the positions of all points
/// of level 0 (12 bytes each) and a few groups. Throws Error for files that cannot be read.
void checkPointLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings);

} // namespace imgeo
