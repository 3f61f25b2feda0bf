#include "containers/stored_coords.h"

#include "base/error.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

constexpr ElementType everyType[] = {ElementType::int8,  ElementType::uint8,  ElementType::int16,  ElementType::uint16,
                                     ElementType::int32, ElementType::uint32, ElementType::float32};
const Lattice testLattice{{-3, 1, 700}, 0.37, 8};

GeometryDescription arrays(ElementType type, std::uint32_t bits) {
  GeometryDescription geometry;
  geometry.encoding = Encoding::bg;
  geometry.coordType = type;
  geometry.lattice = testLattice;
  geometry.lattice.bits = bits;
  return geometry;
}

GeometryDescription images(std::uint32_t bits) {
  GeometryDescription geometry;
  geometry.lattice = testLattice;
  geometry.lattice.bits = bits;
  return geometry;
}

std::vector<GeometryDescription> everyGeometry() {
  std::vector<GeometryDescription> all;
  for (std::uint32_t bits = 8; bits <= 32; ++bits) {
    all.push_back(images(bits));
    for (const ElementType type : everyType)
      if (holdsLattice(type, bits))
        all.push_back(arrays(type, bits));
  }
  return all;
}

std::string nameOf(const GeometryDescription& geometry) {
  return std::string(geometry.encoding == Encoding::classic ? "images" : nameOf(geometry.coordType)) + " of " +
         std::to_string(geometry.lattice.bits) + " bits";
}

bool isFloat(const GeometryDescription& geometry) {
  return geometry.encoding == Encoding::bg && geometry.coordType == ElementType::float32;
}

TEST(StoredCoords, AreDecodedByX3domToLatticePoints) {
  for (const GeometryDescription& geometry : everyGeometry()) {
    if (isFloat(geometry))
      continue;
    SCOPED_TRACE(nameOf(geometry));
    const DecodeFields fields = decodeFields(geometry);
    const StoredCoords stored = storedCoords(geometry.encoding, geometry.coordType, geometry.lattice.bits);
    const bool isSigned = geometry.encoding == Encoding::bg && !isUnsigned(geometry.coordType);
    const std::uint32_t maximum = geometry.lattice.maximum();
    for (const std::uint32_t q : {0u, 1u, maximum / 3, maximum - 1, maximum}) {
      // The formula of X3DOM: docs/formats/nodes.md.
      const double fraction = static_cast<double>(storeCoord(q, stored)) / stored.maximum;
      const double x = fields.position.x + fields.size.x * (isSigned ? fraction : fraction - 0.5);
      EXPECT_NEAR(x, geometry.lattice.point({q, 0, 0}).x, 1e-13 * fields.size.x) << q;
    }
  }
}

TEST(StoredCoords, FitTheirTypeAndDecodeExactly) {
  for (const GeometryDescription& geometry : everyGeometry()) {
    if (isFloat(geometry) || geometry.encoding == Encoding::classic)
      continue;
    SCOPED_TRACE(nameOf(geometry));
    const std::uint32_t maximum = geometry.lattice.maximum();
    const StoredCoords stored = storedCoords(Encoding::bg, geometry.coordType, geometry.lattice.bits);
    const double lowest = isUnsigned(geometry.coordType) ? 0 : -maximumOf(geometry.coordType) - 1;
    for (const std::uint32_t q : {0u, 1u, maximum / 3, maximum}) {
      const std::int64_t value = storeCoord(q, stored);
      EXPECT_GE(static_cast<double>(value), lowest);
      EXPECT_LE(static_cast<double>(value), maximumOf(geometry.coordType));
      EXPECT_EQ(loadCoord(value, stored, ""), q);
    }
    if (stored.shift > 0) {
      EXPECT_THROW(loadCoord(storeCoord(1, stored) + 1, stored, ""), Error);
    }
    EXPECT_THROW(loadCoord(stored.bias - 1, stored, ""), Error);
    EXPECT_THROW(loadCoord(storeCoord(maximum, stored) + (std::int64_t{1} << stored.shift), stored, ""), Error);
  }
}

TEST(StoredCoords, OfSignedTypesStayWithinTheHalfThatX3domUses) {
  for (std::uint32_t bits = 8; bits <= 15; ++bits) {
    const GeometryDescription geometry = arrays(ElementType::int16, bits);
    const StoredCoords stored = storedCoords(Encoding::bg, ElementType::int16, bits);
    EXPECT_GE(storeCoord(0, stored), -16384);
    EXPECT_LE(storeCoord(geometry.lattice.maximum(), stored), 16383);
    const double edge = decodeFields(geometry).size.x, extent = geometry.lattice.step * geometry.lattice.maximum();
    EXPECT_GE(edge, extent * 0.9999);
    EXPECT_LE(edge, extent * 1.004) << "the box is much larger than the mesh";
  }
}

TEST(LatticeFor, HasOriginAndStepWithFewDecimalDigits) {
  // 0.1, 2.01 and 5.505 in single precision. The last differs from 5.505 by more than 1/1024 of a step, so it keeps
  // more digits. `far` has a step below the resolution of single precision.
  Box3d box;
  box.add({0.1f, 0, 5.505f});
  box.add({0.1 + 2.01f, 1, 6});
  const Lattice lattice = latticeFor(box, ElementType::uint16, 16);
  EXPECT_EQ(lattice.origin, (Vec3d{0.1, 0, 5.5050001}));
  EXPECT_EQ(lattice.step, 2.01 / 65535);
  Box3d far;
  far.add({500000.03125, 0, 0});
  far.add({500000.0625, 0, 0});
  EXPECT_NEAR(latticeFor(far, ElementType::uint16, 16).origin.x, 500000.03125, 0.03125 / 65535 / 1024);
  EXPECT_EQ(latticeFor(box, ElementType::uint32, 32).origin, box.min);
}

TEST(DecodeFields, DetermineTheLattice) {
  for (const GeometryDescription& geometry : everyGeometry()) {
    SCOPED_TRACE(nameOf(geometry));
    const Lattice &lattice = geometry.lattice,
                  decoded = latticeOf(decodeFields(geometry), geometry.encoding, geometry.coordType, lattice.bits);
    const double edge = lattice.step * lattice.maximum();
    EXPECT_EQ(decoded.bits, lattice.bits);
    EXPECT_NEAR(decoded.step, lattice.step, 1e-13 * lattice.step);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(decoded.origin[axis], lattice.origin[axis], 1e-13 * edge + 1e-11);
  }
}

TEST(DecodeFields, HaveTheExactEdgeIfBitsFillTheirBytes) {
  GeometryDescription geometry = images(16);
  geometry.lattice.step = 2.0 / 65535;
  EXPECT_DOUBLE_EQ(decodeFields(geometry).size.x, 2);
  EXPECT_EQ(coordBytes(Encoding::classic, 24), 3u);
  EXPECT_EQ(coordBytes(Encoding::bg, 24), 4u);
}

TEST(NearestPoint, KeepsSinglePrecisionValuesOnTheFinestLattice) {
  const Box3d box{{-1, 2, 5}, {3, 2.5, 6}};
  const Lattice lattice = latticeFor(box, ElementType::float32, sourceBits);
  for (const float x : {-1.0f, -0.7f, 0.1f, 1.0f / 3, 2.9999998f, 3.0f}) {
    const Vec3f position{x, 2.2f, 5.5f};
    EXPECT_EQ(Vec3f(lattice.point(nearestPoint(position, lattice, ""))), position);
  }
}

TEST(NearestPoint, RefusesPositionsFarOutsideAndNaN) {
  const Lattice lattice{{0, 0, 0}, 0.25, 10};
  EXPECT_EQ(nearestPoint({255.8f, 0.1f, -0.2f}, lattice, ""), (Vec3u{1023, 0, 0}));
  for (const float x : {-1.0f, 257.0f, std::numeric_limits<float>::infinity(), std::nanf("")})
    EXPECT_THROW(nearestPoint({x, 0, 0}, lattice, "x"), Error) << x;
}

} // namespace
} // namespace imgeo
