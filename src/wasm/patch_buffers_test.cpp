// web/src/decode/compact/wasmDecoder.test.ts compares the arrays of all vectors with those of the TypeScript; here they
// are compared with the patches.
#include "base/file.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "wasm/patch_buffers.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace imgeo::compact {
namespace {

std::vector<CompactPatch> patchesOf(const std::filesystem::path& png) {
  return decodePatches(payloadOfImage(readFile(png), png.stem()), png.stem());
}

std::uint32_t indexAt(ElementArray& index, std::size_t i) {
  return index.type == ElementType::uint16 ? index.as<std::uint16_t>()[i] : index.as<std::uint32_t>()[i];
}

/// The corners of each element, sorted.
template <typename CornerAt>
std::vector<std::array<std::uint32_t, 3>> elementsOf(std::uint32_t perElement, std::size_t cornerCount,
                                                     const CornerAt& cornerAt) {
  std::vector<std::array<std::uint32_t, 3>> elements(cornerCount / perElement);
  for (std::size_t corner = 0; corner < cornerCount; ++corner)
    elements[corner / perElement][corner % perElement] = cornerAt(corner);
  std::ranges::sort(elements);
  return elements;
}

TEST(PatchBuffers, DrawTheElementsOfEveryVector) {
  std::size_t reordered = 0;
  for (const auto& entry : std::filesystem::directory_iterator(IMGEO_VECTORS "/compact-1")) {
    if (entry.path().extension() != ".png")
      continue;
    for (const CompactPatch& patch : patchesOf(entry.path())) {
      SCOPED_TRACE(entry.path().stem());
      PatchBuffers buffers = buffersOf(patch);
      EXPECT_EQ(buffers.vertexCount, patch.wedgeCount());
      if (patch.topology == Topology::points) {
        EXPECT_EQ(buffers.index.length, 0u);
        continue;
      }
      ASSERT_EQ(buffers.index.length, patch.corners.size());
      const std::uint32_t perElement = cornersPerElement(patch.topology);
      const auto stated = [&](std::size_t corner) { return patch.corners[corner]; };
      const auto drawn = [&](std::size_t corner) { return indexAt(buffers.index, corner); };
      EXPECT_EQ(elementsOf(perElement, patch.corners.size(), drawn),
                elementsOf(perElement, patch.corners.size(), stated));
      for (std::size_t corner = 0; corner < patch.corners.size(); ++corner)
        if (drawn(corner) != stated(corner)) {
          ++reordered;
          EXPECT_TRUE(patch.topology == Topology::triangles && patch.segmentCount == 0);
          break;
        }
    }
  }
  EXPECT_GT(reordered, 3u) << "no patch was put into the order of the vertex cache";
}

/// A point with one attribute.
CompactPatch pointWith(AttributeKind kind, std::uint8_t components, std::uint8_t bits, std::int32_t value) {
  Attribute attribute{{kind, components, bits}, {Value{}}};
  for (std::uint32_t i = 0; i < components; ++i)
    attribute.values[0][i] = value;
  CompactPatch patch;
  patch.topology = Topology::points;
  patch.positions = {{1, 2, 3}};
  patch.wedgePositions = patch.corners = {0};
  patch.attributes = {attribute};
  return patch;
}

TEST(PatchBuffers, ScaleColoursAndTextureCoordinatesToTheRangeOfTheirType) {
  PatchBuffers color = buffersOf(pointWith(AttributeKind::color, 3, 5, 17));
  VertexArray& bytes = color.attributes[0].vertices;
  EXPECT_EQ(bytes.elements.type, ElementType::uint8);
  EXPECT_EQ(bytes.stride, 4u);
  EXPECT_EQ(bytes.elements.as<std::uint8_t>()[0], 140); // 17 / 31 * 255 = 139.8
  EXPECT_EQ(bytes.elements.as<std::uint8_t>()[3], 0);   // padding
  PatchBuffers texCoord = buffersOf(pointWith(AttributeKind::texCoord, 2, 12, 4095));
  EXPECT_EQ(texCoord.attributes[0].vertices.elements.as<std::uint16_t>()[1], 65535);
}

TEST(PatchBuffers, KeepOtherNumbersInTheSmallestTypeThatHoldsThem) {
  const auto typeOf = [](std::uint8_t components, std::uint8_t bits) {
    const PatchBuffers buffers = buffersOf(pointWith(AttributeKind::other, components, bits, 1));
    return std::pair(buffers.attributes[0].vertices.elements.type, buffers.attributes[0].vertices.stride);
  };
  EXPECT_EQ(typeOf(1, 8), std::pair(ElementType::uint8, 4u));
  EXPECT_EQ(typeOf(2, 9), std::pair(ElementType::uint16, 2u));
  EXPECT_EQ(typeOf(3, 16), std::pair(ElementType::uint16, 4u));
  EXPECT_EQ(typeOf(3, 17), std::pair(ElementType::float32, 3u));
}

} // namespace
} // namespace imgeo::compact
