#include "import/text/rounded_decimal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace imgeo {
namespace {

TEST(RoundedDecimal, RoundsSinglePrecisionToItsShortestDecimal) {
  EXPECT_EQ(rounded(static_cast<double>(0.3f), 8), 0.3);
  EXPECT_EQ(rounded(static_cast<double>(7.495f), 12), 7.495);
  EXPECT_EQ(rounded(-0.125, 8), -0.125);
  EXPECT_EQ(rounded(500'000.123456, 12), 500'000.123456) << "digits of double precision that matter";
  EXPECT_EQ(rounded(2.7250000000000005, 12), 2.725) << "a rounding error";
}

TEST(RoundedDecimal, ConvertsToTheSameSinglePrecisionNumber) {
  for (std::uint32_t i = 1; i < 4000; ++i) {
    const float value = std::ldexp(std::sin(static_cast<float>(i)), static_cast<int>(i % 60) - 30);
    EXPECT_EQ(static_cast<float>(rounded(static_cast<double>(value), 8)), value);
  }
  for (const double odd : {0.0, 1e300, 1e-300, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(rounded(odd, 12), odd);
}

TEST(RoundedDecimal, KeepsATransform) {
  Transform transform;
  transform.translation = {static_cast<double>(-0.3f), 1234567.890123, 0};
  transform.rotation = {{0, 0.6000000001, 0.8}, 1.5707963267948966};
  const Transform read = rounded(transform);
  EXPECT_EQ(read.translation, (Vec3d{-0.3, 1234567.89012, 0}));
  EXPECT_EQ(read.rotation, (Rotation{{0, 0.6, 0.8}, 1.5707963}));
  EXPECT_EQ(rounded(Transform{}), Transform{});
}

} // namespace
} // namespace imgeo
