#include "transcode/verify/gltf_curve.h"

#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

Interpolator interpolatorWith(InterpolatorKind kind, std::vector<float> keys, std::vector<float> values) {
  Interpolator made;
  made.kind = kind;
  made.keys = std::move(keys);
  made.values = std::move(values);
  return made;
}

Interpolator scalar(std::vector<float> keys, std::vector<float> values) {
  return interpolatorWith(InterpolatorKind::scalar, std::move(keys), std::move(values));
}

bool areEqual(const Interpolator& a, const Interpolator& b) {
  return areEqualCurves({.interpolator = &a, .seconds = 3}, {.interpolator = &b, .seconds = 3});
}

TEST(GltfCurve, EqualsOneWithOtherKeysAndTheSameValues) {
  const Interpolator ramp = scalar({0, 1}, {0, 2});
  EXPECT_TRUE(areEqual(ramp, scalar({0, 0.25F, 0.5F, 1}, {0, 0.5F, 1, 2})));
  EXPECT_TRUE(areEqual(ramp, scalar({0, 1}, {0, 2.000001F})));
  EXPECT_FALSE(areEqual(ramp, scalar({0, 0.5F, 1}, {0, 1.01F, 2})));
  EXPECT_FALSE(areEqual(ramp, scalar({0, 1}, {0, 2.001F})));
  EXPECT_FALSE(areEqual(ramp, scalar({0, 0.999F}, {0, 2})));
}

TEST(GltfCurve, HoldsItsFirstAndLastValue) {
  const Interpolator ramp = scalar({0.25F, 0.5F}, {1, 2});
  EXPECT_TRUE(areEqual(ramp, scalar({0, 0.25F, 0.5F, 1}, {1, 1, 2, 2})));
  EXPECT_FALSE(areEqual(ramp, scalar({0, 0.5F}, {1, 2})));
  EXPECT_FALSE(areEqual(ramp, scalar({0.25F, 0.5F, 1}, {1, 2, 3})));
}

TEST(GltfCurve, HasStepsThatAreMovedByRounding) {
  const Interpolator step = scalar({0, 0.5F, 0.5F, 1}, {0, 0, 1, 1});
  EXPECT_TRUE(areEqual(step, scalar({0, 0.5F, 0.50000006F, 1}, {0, 0, 1, 1})));
  EXPECT_FALSE(areEqual(step, scalar({0, 0.5F, 0.51F, 1}, {0, 0, 1, 1})));
  EXPECT_FALSE(areEqual(step, scalar({0, 0.5F, 0.5F, 1}, {0, 0, 1, 0.9F})));
}

TEST(GltfCurve, MayHaveACycleOfAnotherLength) {
  const Interpolator half = scalar({0, 0.5F}, {0, 1}), whole = scalar({0, 1}, {0, 1});
  EXPECT_TRUE(areEqualCurves({.interpolator = &half, .seconds = 4}, {.interpolator = &whole, .seconds = 2}));
  EXPECT_FALSE(areEqualCurves({.interpolator = &half, .seconds = 4}, {.interpolator = &whole, .seconds = 4}));
}

TEST(GltfCurve, OfRotationsIsThatOfTheirQuaternions) {
  constexpr float pi = std::numbers::pi_v<float>;
  const auto turn = [](std::vector<float> keys, std::vector<float> values) {
    return interpolatorWith(InterpolatorKind::orientation, std::move(keys), std::move(values));
  };
  const Interpolator quarter = turn({0, 1}, {0, 1, 0, 0, 0, 1, 0, pi / 2});
  EXPECT_TRUE(areEqual(quarter, turn({0, 1}, {1, 0, 0, 0, 0, -2, 0, -pi / 2})));
  EXPECT_TRUE(areEqual(quarter, turn({0, 0.5F, 1}, {0, 1, 0, 0, 0, 1, 0, pi / 4, 0, 1, 0, pi / 2})));
  EXPECT_FALSE(areEqual(quarter, turn({0, 1}, {0, 1, 0, 0, 0, -1, 0, pi / 2})));
  // Half a turn may go either way.
  EXPECT_TRUE(areEqual(turn({0, 1}, {0, 1, 0, 0, 0, 1, 0, pi}), turn({0, 1}, {0, 1, 0, 0, 0, -1, 0, pi})));
  EXPECT_FALSE(areEqual(turn({0, 1}, {0, 1, 0, 0, 0, 1, 0, pi}), turn({0, 1}, {0, 1, 0, 0, 1, 0, 0, pi})));
  EXPECT_FALSE(areEqual(quarter, scalar({0, 1}, {0, 1})));
}

TEST(GltfCurve, OfPositionsHasItsOffset) {
  const Interpolator a = interpolatorWith(InterpolatorKind::position, {0, 1}, {0, 0, 0, 1, 2, 3});
  const Interpolator b = interpolatorWith(InterpolatorKind::position, {0, 1}, {4, 0, 0, 5, 2, 3});
  EXPECT_TRUE(areEqualCurves({.interpolator = &a, .offset = {4, 0, 0}}, {.interpolator = &b}));
  EXPECT_FALSE(areEqual(a, b));
}

TEST(GltfCurve, IsConstantWithoutAnInterpolator) {
  const Interpolator rest = scalar({0, 1}, {0.25F, 0.25F}), ramp = scalar({0, 1}, {0.25F, 0.5F});
  EXPECT_TRUE(areEqualCurves({.constant = 0.25}, {.interpolator = &rest}));
  EXPECT_FALSE(areEqualCurves({.constant = 0.25}, {.interpolator = &ramp}));
}

} // namespace
} // namespace imgeo
