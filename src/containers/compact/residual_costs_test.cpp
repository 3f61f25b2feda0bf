#include "containers/compact/residual_costs.h"

#include "containers/compact/candidate_residuals.h"

#include <gtest/gtest.h>
#include <random>

namespace imgeo::compact {
namespace {

constexpr std::size_t contextCount = 5, kindCount = 2, nextBitModel = contextCount * numberModels,
                      modelCount = nextBitModel + kindCount * numberModels;

TEST(ResidualCosts, AreThoseOfCodingWithTheModelsThatTheyFollow) {
  RangeEncoder encoder(modelCount);
  ResidualCosts costs(encoder.models(), 0, contextCount, nextBitModel, kindCount);
  std::mt19937 random(1);
  for (int i = 0; i < 4000; ++i) {
    const std::size_t context = random() % contextCount, kind = random() % kindCount;
    const auto value = static_cast<std::int64_t>(random() >> (8 + random() % 24)) * (random() % 2 ? 1 : -1);
    CostMeter meter(encoder, UINT32_MAX);
    codeLongSigned(meter, numberModels * context, nextBitModel + numberModels * kind, value);
    ASSERT_EQ(costs.costOf(context, kind, residualKey(value)), meter.cost()) << value;
    const SignedNumber coded =
        codeLongSigned(encoder, numberModels * context, nextBitModel + numberModels * kind, value);
    costs.update(context, kind, coded.length);
  }
}

TEST(StepCosts, AreThoseOfCodingWithTheModelsThatTheyFollow) {
  RangeEncoder encoder(modelCount);
  StepCosts costs(encoder.models(), 0, contextCount);
  std::mt19937 random(1);
  for (int i = 0; i < 4000; ++i) {
    const std::size_t context = random() % contextCount;
    const auto steps = static_cast<std::int32_t>(random() % 256 >> random() % 8) * (random() % 2 ? 1 : -1);
    CostMeter meter(encoder, UINT32_MAX);
    codeSmall(meter, numberModels * context, steps);
    ASSERT_EQ(costs.costOf(context, steps), meter.cost()) << steps;
    codeSmall(encoder, numberModels * context, steps);
    costs.update(context);
  }
}

/// Nine candidates of which some lie outside of the lattice.
Candidates nineCandidates(std::mt19937& random, std::int64_t maximum) {
  Candidates candidates;
  for (int i = 0; i < 9; ++i) {
    const auto coordinate = [&] { return static_cast<std::int64_t>(random() % (3 * maximum)) - maximum; };
    candidates.add({coordinate(), coordinate(), coordinate()}, 0);
  }
  return candidates;
}

TEST(CandidateResiduals, AreThoseOfOneCandidateAtATime) {
  std::mt19937 random(2);
  for (int turn = 0; turn < 2000; ++turn) {
    const std::int64_t maximum = (std::int64_t{1} << (4 + random() % 21)) - 1;
    const Candidates candidates = nineCandidates(random, maximum);
    const std::array<int, 3> order{2, 0, 1};
    Coordinates coordinates{}, normal{};
    for (std::size_t i = 0; i < 3; ++i) {
      coordinates[i] = static_cast<std::int64_t>(random()) % (maximum + 1);
      normal[i] = static_cast<std::int64_t>(random() % 65535) - 32767;
    }
    if (random() % 8 == 0)
      normal[2] = static_cast<std::int64_t>(random() % 3) - 1;
    CandidateResiduals residuals(candidates, order, maximum);
    residuals.setKeys(0, coordinates[0]);
    residuals.setKeys(1, coordinates[1]);
    residuals.setKeysOnSlope(normal, coordinates);
    for (std::size_t i = 0; i < candidates.count; ++i) {
      const Vec3i64& guess = candidates.positions[i];
      std::int64_t last = guess[order[2]];
      if (normal[2] != 0)
        last -= (normal[0] * (coordinates[0] - guess[order[0]]) + normal[1] * (coordinates[1] - guess[order[1]])) /
                normal[2];
      const std::array<std::int64_t, 3> expected{guess[order[0]], guess[order[1]], last};
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ(static_cast<std::uint32_t>(residuals.at(axis, i)),
                  residualKey(coordinates[axis] - std::clamp<std::int64_t>(expected[axis], 0, maximum)));
    }
  }
}

TEST(CandidateResiduals, CountTheStepsBetweenLinesOfAGrid) {
  std::mt19937 random(3);
  for (int turn = 0; turn < 2000; ++turn) {
    const std::int64_t maximum = (std::int64_t{1} << (6 + random() % 19)) - 1;
    const std::uint64_t step = (std::uint64_t{16} << 16) + (random() >> random() % 16);
    const VertexGrid grid{{random() % step, 0, 0}, {step, step, step}};
    const Candidates candidates = nineCandidates(random, maximum);
    const std::int64_t line = nearestGridLine(grid, 0, static_cast<std::int64_t>(random()) % (maximum + 1));
    CandidateResiduals residuals(candidates, {0, 1, 2}, maximum);
    residuals.setSteps(0, grid, 0, line);
    for (std::size_t i = 0; i < candidates.count; ++i)
      ASSERT_EQ(residuals.at(0, i),
                line - nearestGridLine(grid, 0, std::clamp<std::int64_t>(candidates.positions[i].x, 0, maximum)));
  }
}

} // namespace
} // namespace imgeo::compact
