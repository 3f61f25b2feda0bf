#include "containers/named_attributes.h"

#include "base/error.h"
#include "containers/container_reader.h"
#include "containers/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A grid with one attribute that repeats these values.
PatchedMesh withValues(const std::vector<float>& values, std::uint32_t components = 1) {
  Mesh mesh = testing::grid(9);
  NamedAttribute attribute{"heat", components, {}};
  for (std::size_t i = 0; i < mesh.wedgeCount() * components; ++i)
    attribute.values.push_back(values[i % values.size()]);
  mesh.namedAttributes.push_back(attribute);
  return testing::onePatch(mesh, 16);
}

NamedAttribute readBack(const PatchedMesh& mesh, const EncodeOptions& options) {
  const GeometryDescription geometry = describe(mesh, options);
  const IndexedPatch vertices = testing::verticesOf(mesh.patches[0], Primitive::triangles, true);
  const EncodedPatch encoded = encodePatch(vertices, geometry, options);
  return decodePatch(encoded, geometry).namedAttributes.at(0);
}

TEST(NamedAttributes, StoreIntegersExactlyInAsFewBytesAsTheyNeed) {
  struct {
    std::vector<float> values;
    std::uint32_t bits, bytes;
  } const cases[] = {
      {{0, 255, 7}, 16, 1},      {{-5, 250, 0}, 16, 1}, {{0, 256, 7}, 16, 2}, {{1e6f, 1e6f + 65535}, 24, 2},
      {{0, 16777215, 5}, 24, 3}, {{42}, 24, 1},         {{0.5f}, 24, 1},      {{0.5f, 0.25f}, 24, 3}};
  for (const auto& c : cases) {
    const PatchedMesh mesh = withValues(c.values);
    const EncodeOptions options{.attributeBits = c.bits};
    const AttributeDescription described = describe(mesh, options).attributes.at(0);
    EXPECT_EQ(described.bytes, c.bytes) << c.values[0];
    const bool isExact = c.values[0] == std::floor(c.values[0]) || c.values.size() == 1;
    if (isExact) {
      EXPECT_EQ(readBack(mesh, options), mesh.patches[0].namedAttributes[0]) << c.values[0];
    }
  }
}

TEST(NamedAttributes, AreExactAsTypedArrays) {
  const PatchedMesh mesh = withValues({1e-30f, -3.25f, 1e30f, 0.1f, 7}, 3);
  for (const Layout layout : {Layout::separate, Layout::interleaved})
    EXPECT_EQ(readBack(mesh, {.encoding = Encoding::bg, .layout = layout}), mesh.patches[0].namedAttributes[0]);
}

TEST(NamedAttributes, AreQuantisedOverTheirRange) {
  const PatchedMesh mesh = withValues({-1.5f, 2.5f, 0.3f});
  const EncodeOptions options{.attributeBits = 8};
  const AttributeDescription described = describe(mesh, options).attributes.at(0);
  EXPECT_EQ(described.min, std::vector<double>{-1.5});
  EXPECT_EQ(described.size, std::vector<double>{4});
  EXPECT_NEAR(numberErrorBound(Encoding::classic, described, 0), 2.0 / 255, 1e-6);
  EXPECT_NE(readBack(mesh, options).values[2], 0.3f);
  EXPECT_NEAR(readBack(mesh, options).values[2], 0.3f, numberErrorBound(Encoding::classic, described, 0));
}

TEST(NamedAttributes, AreRefusedIfFilesAreMissingOrHoldNaN) {
  const PatchedMesh mesh = withValues({1, 2, 300});
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    const EncodeOptions options{.encoding = encoding};
    const GeometryDescription geometry = describe(mesh, options);
    EncodedPatch encoded =
        encodePatch(testing::verticesOf(mesh.patches[0], Primitive::triangles, true), geometry, options);
    PatchDescription description = testing::describedByIndex(encoded);
    if (encoding == Encoding::bg) {
      Bytes& bytes = encoded.files.back().bytes;
      std::fill(bytes.begin(), bytes.begin() + 4, std::uint8_t{255}); // a NaN
      EXPECT_THROW(decodePatch(description, geometry, testing::filesOf(encoded)), Error);
    }
    description.attributes[0].pop_back();
    EXPECT_THROW(decodePatch(description, geometry, testing::filesOf(encoded)), Error);
    description.attributes.clear();
    EXPECT_THROW(decodePatch(description, geometry, testing::filesOf(encoded)), Error);
  }
}

} // namespace
} // namespace imgeo
