#include "containers/compact/patch_coding.h"

#include "base/error.h"

#include <cstdlib>
#include <string>

namespace {

void require(bool condition) {
  if (!condition)
    std::abort();
}

/// Requires that the arrays of a decoded patch have matching sizes and that indices are in range.
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
  require(patch.segments.size() == (patch.segmentCount > 0 ? patch.elementCount() : 0));
  for (const std::uint32_t segment : patch.segments)
    require(segment < patch.segmentCount);
}

/// Checks each patch, and that the patches can be encoded and decoded again.
void checkAll(const std::vector<imgeo::compact::CompactPatch>& patches) {
  using namespace imgeo::compact;
  for (const CompactPatch& patch : patches)
    check(patch);
  const std::vector<CompactPatch> again = decodePatches(encodePatches(patches, 0).bytes, "again");
  require(again.size() == patches.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    const CompactPatch &a = again[i], &b = patches[i];
    require(a.positions.size() == b.positions.size() && a.wedgeCount() == b.wedgeCount() &&
            a.corners.size() == b.corners.size() && a.segmentCount == b.segmentCount);
  }
}

} // namespace

/// Inputs are payloads, not images. Mutated PNG files would fail at their checksums in the PNG reader, which has a fuzz
/// target of its own.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    checkAll(imgeo::compact::decodePatches({data, size}, "x.png"));
  } catch (const imgeo::Error& error) {
    require(!error.message().empty());
  }
  return 0;
}
