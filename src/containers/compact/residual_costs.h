#pragma once
// What residuals of positions would cost (codeLongSigned of symbols.h), in tables that follow the models: for each
// vertex an encoder measures three residuals of up to nine candidates, and codes three.

#include "containers/compact/number_costs.h"
#include "containers/compact/symbols.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace imgeo::compact {

/// The cost of a tree of four bits (codeTree).
inline std::uint32_t costOfFourBits(const Model* models, std::uint32_t value) {
  const std::uint32_t leaf = 16 | value;
  return costOfBit(models[1], leaf >> 3 & 1) + costOfBit(models[leaf >> 3], leaf >> 2 & 1) +
         costOfBit(models[leaf >> 2], leaf >> 1 & 1) + costOfBit(models[leaf >> 1], leaf & 1);
}

/// Costs are in 1/65536 bits.
class ResidualCosts {
public:
  /// There are `contextCount` groups of `numberModels` models from `lengthModels` on, and `kindCount` from `nextBit`
  /// on.
  ResidualCosts(const Models& models, std::size_t lengthModels, std::size_t contextCount, std::size_t nextBit,
                std::size_t kindCount)
      : lengthModels_(models.data() + lengthModels), nextBit_(models.data() + nextBit), contexts_(contextCount),
        kinds_(kindCount) {
    for (std::size_t context = 0; context < contextCount; ++context)
      for (std::uint32_t length = 0; length < treeLeaves; length += 4)
        updateLengths(context, length);
    for (std::size_t kind = 0; kind < kindCount; ++kind)
      for (std::uint32_t length = 0; length < numberModels; ++length)
        updateRest(kind, length);
  }

  /// The cost of a residual, whose key is that of residualKey().
  std::uint32_t costOf(std::size_t context, std::size_t kind, std::uint32_t key) const {
    const std::uint32_t length = key / 2;
    const std::uint32_t cost = contexts_[context].costs[std::min(length, lastLeaf)] + kinds_[kind][key];
    if (length < lastLeaf) [[likely]]
      return cost;
    return cost + costOfFourBits(lengthModels_ + numberModels * context + 16, length - lastLeaf);
  }

  /// Follows the models when a residual of `length` bits has been coded.
  void update(std::size_t context, std::size_t kind, std::uint32_t length) {
    updateLengths(context, std::min(length, lastLeaf));
    updateRest(kind, length);
  }

private:
  static constexpr std::uint32_t treeLeaves = 16, lastLeaf = treeLeaves - 1;

  /// The cost of a length, or of its first four bits, and the part of the last two of these.
  struct Lengths {
    alignas(16) std::array<std::uint32_t, treeLeaves> costs, lower;
  };

  /// Follows the models of the first two bits of lengths, and of those of `length`.
  void updateLengths(std::size_t context, std::uint32_t length) {
    const Model* const models = lengthModels_ + numberModels * context;
    Lengths& lengths = contexts_[context];
    const std::uint32_t quarter = length / 4;
    for (std::uint32_t i = 0; i < 4; ++i)
      lengths.lower[4 * quarter + i] =
          costOfBit(models[4 + quarter], i >> 1) + costOfBit(models[8 + 2 * quarter + (i >> 1)], i & 1);
    for (std::uint32_t first = 0; first < 4; ++first) {
      const std::uint32_t upper = costOfBit(models[1], first >> 1) + costOfBit(models[2 + (first >> 1)], first & 1);
      for (std::uint32_t i = 0; i < 4; ++i)
        lengths.costs[4 * first + i] = upper + lengths.lower[4 * first + i];
    }
  }

  /// Follows the model of the bit after the first. The others and the sign are raw bits.
  void updateRest(std::size_t kind, std::uint32_t length) {
    const std::uint32_t raw = (length < 2 ? length : length - 1) << 16;
    for (const std::uint32_t bit : {0u, 1u})
      kinds_[kind][2 * length + bit] = length < 2 ? raw : raw + costOfBit(nextBit_[numberModels * kind + length], bit);
  }

  const Model *lengthModels_, *nextBit_; ///< the first ones
  std::vector<Lengths> contexts_;
  std::vector<std::array<std::uint32_t, 2 * numberModels>> kinds_;
};

/// What steps on a grid would cost (codeSmall), likewise. Most are 0.
class StepCosts {
public:
  /// There are `contextCount` groups of `numberModels` models from `firstModel` on.
  StepCosts(const Models& models, std::size_t firstModel, std::size_t contextCount)
      : models_(models.data() + firstModel), contexts_(contextCount) {
    for (std::size_t context = 0; context < contextCount; ++context)
      update(context);
  }

  std::uint32_t costOf(std::size_t context, std::int32_t steps) const {
    const auto length = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint32_t>(std::abs(steps))));
    if (length < lengths) [[likely]]
      return contexts_[context][length];
    return costOfSmall(models_ + numberModels * context, steps);
  }

  /// Follows the models of a context when a number of steps has been coded.
  void update(std::size_t context) {
    const Model* const models = models_ + numberModels * context;
    std::uint32_t longer = 0; // the cost of not being shorter
    for (std::uint32_t length = 0; length < lengths; ++length) {
      contexts_[context][length] = longer + costOfBit(models[length], true) + (length << 16);
      longer += costOfBit(models[length], false);
    }
  }

private:
  static constexpr std::uint32_t lengths = 4; ///< that the table holds

  const Model* models_; ///< the first one
  std::vector<std::array<std::uint32_t, lengths>> contexts_;
};

} // namespace imgeo::compact
