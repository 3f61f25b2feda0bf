#include "containers/compact/patch_coding.h"

#include "base/error.h"
#include "containers/compact/patch_samples.h"

#include <gtest/gtest.h>

namespace imgeo::compact {
namespace {

/// A corner as what can be told of it, whatever its number.
using CornerText = std::vector<std::int64_t>;
using ElementText = std::vector<CornerText>;

CornerText textOf(const CompactPatch& patch, std::uint32_t wedge) {
  const Vec3u& at = patch.positions[patch.wedgePositions[wedge]];
  CornerText text{at.x, at.y, at.z};
  for (const Attribute& attribute : patch.attributes)
    if (!attribute.type.isDerived())
      for (std::uint32_t i = 0; i < attribute.type.components; ++i)
        text.push_back(attribute.values[wedge][i]);
  return text;
}

/// The elements in an order of their own, each turned to its least rotation.
std::vector<ElementText> elementsOf(const CompactPatch& patch) {
  const std::size_t count = cornersPerElement(patch.topology);
  std::vector<ElementText> elements;
  for (std::size_t first = 0; first < patch.corners.size(); first += count) {
    ElementText element;
    for (std::size_t i = 0; i < count; ++i)
      element.push_back(textOf(patch, patch.corners[first + i]));
    ElementText least = element;
    for (std::size_t turn = 1; turn < count && count == 3; ++turn) {
      std::rotate(element.begin(), element.begin() + 1, element.end());
      least = std::min(least, element);
    }
    elements.push_back(least);
  }
  std::ranges::sort(elements);
  return elements;
}

void expectComesBack(const CompactPatch& patch) {
  const Bytes bytes = encodePatchBytes(patch, 0).bytes;
  const CompactPatch back = decodePatchBytes(bytes, 0, "x.png");
  EXPECT_EQ(back.topology, patch.topology);
  EXPECT_EQ(back.positionBits, patch.positionBits);
  EXPECT_EQ(back.positions.size(), patch.positions.size());
  EXPECT_EQ(back.wedgeCount(), patch.wedgeCount());
  ASSERT_EQ(back.attributes.size(), patch.attributes.size());
  for (std::size_t i = 0; i < back.attributes.size(); ++i)
    EXPECT_EQ(back.attributes[i].type, patch.attributes[i].type);
  EXPECT_EQ(elementsOf(back), elementsOf(patch));
}

TEST(Compact, GivesBackRandomMeshes) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    AttributeBits bits{4 + seed % 13, 1 + seed % 16, 1 + seed % 8, static_cast<NormalMode>(seed / 2 % 4)};
    expectComesBack(testing::patchOf(imgeo::testing::randomMesh(seed), 8 + seed % 23, bits));
    if (HasFailure())
      return;
  }
}

} // namespace
} // namespace imgeo::compact
