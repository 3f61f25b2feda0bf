#include "containers/compact/patch_coding.h"

#include "base/error.h"

#include <cstdlib>
#include <string>

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

/// Everything that decodes fits together, and comes back as many when it is encoded again.
void check(const imgeo::compact::CompactPatch& patch) {
  using namespace imgeo::compact;
  require(patch.elementCount() > 0 && patch.wedgeCount() >= patch.positions.size());
  require(patch.corners.size() == patch.elementCount() * cornersPerElement(patch.topology));
  for (const imgeo::Vec3u& position : patch.positions)
    for (int axis = 0; axis < 3; ++axis)
      require(position[axis] >> patch.positionBits == 0);
  for (const std::uint32_t position : patch.wedgePositions)
    require(position < patch.positions.size());
  for (const std::uint32_t wedge : patch.corners)
    require(wedge < patch.wedgeCount());
  for (const Attribute& attribute : patch.attributes)
    require(attribute.values.size() == patch.wedgeCount());
  require(patch.parts.size() == (patch.partCount > 0 ? patch.elementCount() : 0));
  for (const std::uint32_t part : patch.parts)
    require(part < patch.partCount);
  const CompactPatch again = decodePatchBytes(encodePatchBytes(patch, 0).bytes, 0, "again");
  require(again.positions.size() == patch.positions.size() && again.wedgeCount() == patch.wedgeCount() &&
          again.corners.size() == patch.corners.size() && again.partCount == patch.partCount);
}

} // namespace

/// Payloads, not images: behind check sums no mutation would get further than the
/// PNG reader, which has a target of its own.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check(imgeo::compact::decodePatchBytes({data, size}, 0, "x.png"));
  } catch (const imgeo::Error& error) {
    require(!error.message().empty());
  }
  return 0;
}
