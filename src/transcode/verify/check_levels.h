#pragma once
// Checks the levels of detail of a geometry against one another.

#include "containers/patch_reader.h"
#include "transcode/verify/findings.h"

namespace imgeo {

/// Reads all groups and checks that each has the border of its coarse form, so that every legal cut is closed where the
/// mesh is, that no group is farther from its coarse form than the index states, and that spheres contain both.
/// Reading has checked that errors and spheres nest. Memory holds the index, the borders of a run of groups of a level
/// and of those around, and a few groups. Throws Error for files that cannot be read.
void checkLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings);

} // namespace imgeo
