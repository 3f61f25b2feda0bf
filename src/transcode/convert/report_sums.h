#pragma once
// What a report says of everything that has been written.

#include "imgeo/convert.h"
#include "imgeo/site.h"

#include <vector>

namespace imgeo {

/// Warns if more than 1 % of the elements collapsed on the lattice. Fewer are normal: scans contain slivers.
void warnOfCollapsed(ConvertReport& report);

/// Bytes by role, in the order of the roles' first files.
std::vector<RoleBytes> sumByRole(const std::vector<SiteFile>& files);

} // namespace imgeo
