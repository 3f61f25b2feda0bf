#include "transcode/convert/report_sums.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

void warnOfCollapsed(ConvertReport& report) {
  const auto warn = [&](Topology topology, const char* lost) {
    if (const std::size_t count = report.collapsed.of(topology); 100 * count > report.elements.of(topology))
      report.warnings.push_back(fmt::format("{} of {} {} have no {} at {} bits", count, report.elements.of(topology),
                                            nameOf(topology), lost, report.minPositionBits));
  };
  warn(Topology::triangles, "area");
  warn(Topology::lines, "length");
}

std::vector<RoleBytes> sumByRole(const std::vector<SiteFile>& files) {
  std::vector<RoleBytes> roles;
  for (const SiteFile& file : files) {
    auto role = std::ranges::find(roles, file.role, &RoleBytes::role);
    if (role == roles.end())
      role = roles.insert(role, {file.role, 0, 0});
    role->bytes += file.bytes;
    ++role->files;
  }
  return roles;
}

} // namespace imgeo
