#pragma once
// Encodes and decodes positions by the same loop: docs/formats/compact.md, "Positions".

#include "containers/compact/candidate_residuals.h"
#include "containers/compact/number_costs.h"
#include "containers/compact/prediction.h"
#include "containers/compact/residual_costs.h"
#include "containers/compact/symbols.h"
#include "prepare/vertex_grid.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <type_traits>

namespace imgeo::compact {

/// Kinds of residuals: those of coordinates off the grid, in the order of coding, and of a lone one.
enum class Residual : std::uint8_t { first, second, third, lone };
inline constexpr std::size_t residualKinds = 4;

/// The first model of each symbol in the stream.
struct PositionModels {
  std::size_t choice;       ///< `choicesOfSet` for each set and agreement of candidates
  std::size_t choicesOfSet; ///< at least the number of candidates less one
  std::array<std::size_t, residualKinds> residual;
  std::size_t line, mask;
  std::size_t nextBit; ///< version 2: the bit after the first of residuals, 32 for each kind
  std::size_t count;
};

constexpr PositionModels positionModelsOf(Version version) {
  const bool isOld = version == Version::one;
  const std::size_t sets = isOld ? 8 : 32, choices = isOld ? 4 : 8, firstContexts = isOld ? 16 : 24;
  const std::size_t first = sets * 16 * choices, second = first + firstContexts * numberModels,
                    third = second + 31 * numberModels, lone = third + 31 * numberModels,
                    line = lone + 8 * numberModels, mask = line + 96 * numberModels,
                    nextBit = mask + std::size_t{512} * 8;
  return {0,
          choices,
          {first, second, third, lone},
          line,
          mask,
          nextBit,
          nextBit + (isOld ? 0 : residualKinds * numberModels)};
}

/// What the positions of a patch are coded by.
struct PositionTraits {
  std::uint32_t bits;        ///< of a coordinate
  std::uint32_t normalShift; ///< of edges, before their cross products
  const std::optional<VertexGrid>& grid;
};

/// Prediction and contexts of a vertex.
struct VertexContext {
  std::uint32_t agreement = 0;
  std::uint32_t mask = 0;            ///< axes on the grid, as bits
  std::uint32_t shift = 0;           ///< of residuals
  std::uint32_t first = 0;           ///< of the first residual
  std::array<int, 3> order{0, 1, 2}; ///< of the axes
  Coordinates normal{};              ///< of the surface

  /// Sets the order of the axes: those on the grid first; of the others, the dominant axis of the surface normal last.
  void setOrder(const Slope& slope) {
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (mask >> axis & 1)
        order[count++] = axis;
    for (int turn = 1; turn <= 3; ++turn)
      if (const int axis = (slope.axis + turn) % 3; !(mask >> axis & 1))
        order[count++] = axis;
    normal = inOrder(slope.normal);
  }

  template <typename T> Coordinates inOrder(const Vec3<T>& vector) const {
    return {vector[order[0]], vector[order[1]], vector[order[2]]};
  }
};

/// Residuals of a base that have coarser steps than the lattice.
struct CoarseResiduals {
  std::uint32_t shift = 0;
  const std::vector<bool>* isExact = nullptr; ///< per vertex; used only if `shift` > 0

  std::uint32_t shiftOf(std::uint32_t vertex) const { return shift > 0 && !(*isExact)[vertex] ? shift : 0; }
};

template <typename Coder> class PositionCoder {
public:
  /// `positions` are the vertices' positions for an encoder, which replaces them by those that decoders return; a
  /// decoder fills them. Arguments that are passed by reference must outlive the PositionCoder.
  PositionCoder(Coder& coder, Version version, const Connectivity& connectivity, const PositionTraits& traits,
                CoarseResiduals residuals, std::vector<Vec3u>& positions)
      : coder_(coder), version_(version), models_(positionModelsOf(version)), connectivity_(connectivity),
        predictor_(version, connectivity, positions, traits.bits), maximum_((std::int64_t{1} << traits.bits) - 1),
        grid_(traits.grid), residuals_(residuals), positions_(positions),
        sums_(connectivity.across.empty() ? 0 : positions.size(), traits.normalShift),
        masks_(traits.grid ? positions.size() : 0), sizes_(version == Version::one ? 0 : positions.size()) {
    for (int axis = 0; axis < 3 && grid_; ++axis)
      lastLines_[axis] = nearestGridLine(*grid_, axis, maximum_);
    if constexpr (Coder::encodes)
      if (version != Version::one)
        costs_.emplace(coder.models(), models_);
  }

  /// Codes all positions. Returns the sums of the triangle normals around each vertex; empty for points and lines.
  NormalSums run() {
    const std::vector<std::uint32_t>& vertex = connectivity_.vertex;
    for (std::uint32_t triangle = 0; triangle < connectivity_.across.size(); ++triangle) {
      const std::uint32_t* corner = &vertex[std::size_t{triangle} * 3];
      for (std::uint32_t i = 0; i < 3; ++i)
        if (corner[i] == next_)
          codeVertex(connectivity_.across[triangle]);
      const auto normal = sums_.normalOf(positions_[corner[0]], positions_[corner[1]], positions_[corner[2]]);
      for (std::uint32_t i = 0; i < 3; ++i)
        sums_.add(corner[i], normal);
    }
    while (next_ < positions_.size()) // points and lines
      codeVertex(none);
    return std::move(sums_);
  }

private:
  struct Costs {
    ResidualCosts ofResiduals;
    StepCosts ofSteps;

    Costs(const Models& models, const PositionModels& at)
        : ofResiduals(models, at.residual[0], (at.line - at.residual[0]) / numberModels, at.nextBit, residualKinds),
          ofSteps(models, at.line, (at.mask - at.line) / numberModels) {}
  };
  struct Nothing {};

  void codeVertex(std::uint32_t across) {
    const std::uint32_t vertex = next_++;
    const Candidates candidates = predictor_.candidatesFor(vertex, across);
    VertexContext context;
    context.agreement = candidates.agreement();
    context.shift = residuals_.shiftOf(vertex);
    context.first = context.agreement;
    if (version_ != Version::one)
      context.first = (context.agreement + nearContext(vertex, across)) / 2;
    if (grid_)
      context.mask = codeMask(vertex, across);
    Slope slope;
    if (across != none)
      slope = Slope(sums_[connectivity_.vertex[before(across)]], sums_[connectivity_.vertex[after(across)]]);
    context.setOrder(slope);
    Coordinates coordinates{};
    std::uint32_t choice = 0;
    if constexpr (Coder::encodes) {
      coordinates = context.inOrder(positions_[vertex]);
      choice = cheapest(candidates, context, coordinates);
    }
    choice = codeChoice(coder_, candidates, context, choice);
    const std::uint32_t size =
        codeCoordinates(coder_, context.inOrder(candidates.positions[choice]), context, coordinates);
    if (version_ != Version::one)
      sizes_[vertex] = size;
    for (std::size_t turn = 0; turn < 3; ++turn)
      positions_[vertex][context.order[turn]] = static_cast<std::uint32_t>(coordinates[turn]);
  }

  /// A context of 0 .. 31: the size of the residuals of the triangle behind the edge, or three times that of the
  /// vertex before, in half bits.
  std::uint32_t nearContext(std::uint32_t vertex, std::uint32_t across) const {
    std::uint32_t size = vertex > 0 ? 3 * sizes_[vertex - 1] : 0;
    if (across != none)
      size = sizes_[connectivity_.vertex[across]] + sizes_[connectivity_.vertex[after(across)]] +
             sizes_[connectivity_.vertex[before(across)]];
    const auto length = static_cast<std::uint32_t>(std::bit_width(size));
    return length < 2 ? length : std::min(31u, 2 * (length - 1) + (size >> (length - 2) & 1));
  }

  std::uint32_t codeMask(std::uint32_t vertex, std::uint32_t across) {
    std::uint32_t neighbours = 0, mask = 0;
    if (across != none)
      for (const std::uint32_t corner : {before(across), after(across), across})
        neighbours = neighbours * 8 + masks_[connectivity_.vertex[corner]];
    if constexpr (Coder::encodes)
      mask = gridMask(*grid_, positions_[vertex]);
    mask = codeTree(coder_, models_.mask + std::size_t{8} * neighbours, 3, mask);
    masks_[vertex] = static_cast<std::uint8_t>(mask);
    return mask;
  }

  /// The candidate with the lowest cost, the first of equals.
  std::uint32_t cheapest(const Candidates& candidates, const VertexContext& context, const Coordinates& coordinates) {
    if (candidates.count == 1)
      return 0;
    if (version_ == Version::one || context.shift > 0 || maximum_ >= CandidateResiduals::limit)
      return cheapestOfFew(candidates, context, coordinates);
    const CandidateResiduals residuals = residualsOf(candidates, context, coordinates);
    const Model* const choices = coder_.models().data() + choiceModels(candidates, context);
    const int lines = std::popcount(context.mask);
    std::uint32_t best = 0, minCost = std::numeric_limits<std::uint32_t>::max(), othersRefused = 0;
    for (std::uint32_t i = 0; i < candidates.count; ++i) {
      std::uint32_t cost = othersRefused + costOf(residuals, i, lines, context);
      if (i + 1 < candidates.count) {
        cost += costOfBit(choices[i], true);
        othersRefused += costOfBit(choices[i], false);
      }
      best = cost < minCost ? i : best;
      minCost = std::min(cost, minCost);
    }
    return best;
  }

  /// By turn: the residuals of the candidates.
  CandidateResiduals residualsOf(const Candidates& candidates, const VertexContext& context,
                                 const Coordinates& coordinates) const {
    CandidateResiduals residuals(candidates, context.order, maximum_);
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const int axis = context.order[turn];
      if (context.mask >> axis & 1)
        residuals.setSteps(turn, *grid_, axis, nearestGridLine(*grid_, axis, coordinates[turn]));
      else if (turn < 2)
        residuals.setKeys(turn, coordinates[turn]);
      else
        residuals.setKeysOnSlope(context.normal, coordinates);
    }
    return residuals;
  }

  /// What the residuals of a candidate cost, in 1/65536 bits; the first `lines` are steps on the grid.
  std::uint32_t costOf(const CandidateResiduals& residuals, std::uint32_t candidate, int lines,
                       const VertexContext& context) const {
    std::uint32_t cost = 0, steps = 0;
    for (std::size_t turn = 0; turn < static_cast<std::size_t>(lines); ++turn) {
      const std::int32_t moved = residuals.at(turn, candidate);
      cost += costs_->ofSteps.costOf(lineContext(turn, steps, context), moved);
      steps += std::min(static_cast<std::uint32_t>(std::abs(moved)), 7u);
    }
    const auto costOfResidual = [&](Residual kind, std::uint32_t number, std::uint32_t key) {
      const auto index = static_cast<std::size_t>(kind);
      return costs_->ofResiduals.costOf(residualContext(index, number), index, key);
    };
    const auto key = [&](std::size_t turn) { return static_cast<std::uint32_t>(residuals.at(turn, candidate)); };
    switch (lines) {
    case 0:
      return costOfResidual(Residual::first, context.first, key(0)) +
             costOfResidual(Residual::second, key(0) / 2, key(1)) +
             costOfResidual(Residual::third, std::max(key(0), key(1)) / 2, key(2));
    case 1:
      return cost + costOfResidual(Residual::first, context.first, key(1)) +
             costOfResidual(Residual::second, key(1) / 2, key(2));
    case 2:
      return cost + costOfResidual(Residual::lone, std::min(steps, 7u), key(2));
    default:
      return cost;
    }
  }

  /// The same as `cheapest`, by coding with a CostMeter: for residuals of version 1, coarse ones, which bases have, and
  /// very precise ones.
  std::uint32_t cheapestOfFew(const Candidates& candidates, const VertexContext& context,
                              const Coordinates& coordinates) {
    std::uint32_t best = 0;
    std::uint32_t minCost = std::numeric_limits<std::uint32_t>::max();
    for (std::uint32_t i = 0; i < candidates.count; ++i) {
      CostMeter meter(coder_, minCost);
      codeChoice(meter, candidates, context, i);
      Coordinates coded = coordinates;
      codeCoordinates(meter, context.inOrder(candidates.positions[i]), context, coded);
      if (meter.cost() < minCost)
        minCost = meter.cost(), best = i;
    }
    return best;
  }

  /// The first model of the choice among candidates.
  std::size_t choiceModels(const Candidates& candidates, const VertexContext& context) const {
    return models_.choice + (std::size_t{candidates.set} * 16 + context.agreement) * models_.choicesOfSet;
  }
  /// The context of a coordinate on the grid.
  static std::size_t lineContext(std::size_t turn, std::uint32_t steps, const VertexContext& context) {
    return (turn * 4 + std::min(steps, 3u)) * 8 + context.agreement / 2;
  }
  /// The kind of a residual; `offGrid`: the number of those before.
  static Residual kindOf(std::size_t turn, std::uint32_t offGrid) {
    return offGrid == 1   ? Residual::second
           : offGrid == 2 ? Residual::third
           : turn == 2    ? Residual::lone
                          : Residual::first;
  }

  template <typename C>
  std::uint32_t codeChoice(C& coder, const Candidates& candidates, const VertexContext& context,
                           std::uint32_t choice) const {
    const std::size_t models = choiceModels(candidates, context);
    std::uint32_t i = 0;
    while (i + 1 < candidates.count && !coder.bit(models + i, i == choice))
      ++i;
    return i;
  }

  /// Returns the size of the residuals off the grid, at most 2^24.
  template <typename C>
  std::uint32_t codeCoordinates(C& coder, const Coordinates& guess, const VertexContext& context,
                                Coordinates& coordinates) {
    std::uint32_t steps = 0, offGrid = 0, length = 0, longest = 0;
    std::int64_t size = 0;
    for (std::size_t turn = 0; turn < 3; ++turn) {
      if constexpr (requires { coder.isSpent(); })
        if (coder.isSpent())
          break;
      const int axis = context.order[turn];
      std::int64_t expected = std::clamp<std::int64_t>(guess[turn], 0, maximum_), coordinate = coordinates[turn];
      if (context.mask >> axis & 1) {
        const std::int64_t line = nearestGridLine(*grid_, axis, expected);
        const std::size_t number = lineContext(turn, steps, context), models = models_.line + numberModels * number;
        const std::int64_t moved = codeSmall(coder, models, nearestGridLine(*grid_, axis, coordinate) - line).value;
        if constexpr (std::is_same_v<C, RangeEncoder>)
          if (costs_)
            costs_->ofSteps.update(number);
        steps += static_cast<std::uint32_t>(std::min<std::int64_t>(std::abs(moved), 7));
        coder.require(line + moved >= -1 && line + moved <= lastLines_[axis], "a line of the grid is outside");
        coordinate = gridLine(*grid_, axis, line + moved);
      } else {
        if (turn == 2)
          expected = onSlope(guess, context.normal, coordinates);
        const Residual kind = kindOf(turn, offGrid);
        const std::uint32_t contexts[] = {context.first, length, longest, std::min(steps, 7u)}; // by kind
        const SignedNumber residual = codeResidual(coder, kind, contexts[static_cast<std::size_t>(kind)],
                                                   stepsBetween(expected, coordinate, context.shift));
        ++offGrid;
        length = residual.length;
        longest = std::max(longest, length);
        size += std::abs(std::int64_t{residual.value});
        coordinate = expected + (std::int64_t{residual.value} << context.shift);
      }
      coder.require(coordinate >= 0 && coordinate <= maximum_, "a coordinate lies outside of the lattice");
      coordinates[turn] = coordinate;
    }
    return static_cast<std::uint32_t>(std::min<std::int64_t>(size, 1 << 24));
  }

  /// Codes a residual off the grid.
  template <typename C> SignedNumber codeResidual(C& coder, Residual kind, std::uint32_t context, std::int64_t value) {
    const auto index = static_cast<std::size_t>(kind);
    const std::size_t models = models_.residual[index] + numberModels * context;
    if (version_ == Version::one)
      return codeSigned(coder, models, value);
    const SignedNumber residual = codeLongSigned(coder, models, models_.nextBit + numberModels * index, value);
    if constexpr (std::is_same_v<C, RangeEncoder>)
      costs_->ofResiduals.update(residualContext(index, context), index, residual.length);
    return residual;
  }

  /// The number of a context among those of the residuals of all kinds.
  std::size_t residualContext(std::size_t kind, std::uint32_t context) const {
    return (models_.residual[kind] - models_.residual[0]) / numberModels + context;
  }

  /// Rounds a residual to coarser steps without leaving the lattice.
  std::int64_t stepsBetween(std::int64_t from, std::int64_t to, std::uint32_t shift) const {
    if (shift == 0)
      return to - from;
    std::int64_t steps = (to - from + (std::int64_t{1} << (shift - 1))) >> shift;
    steps -= from + (steps << shift) > maximum_;
    return steps + (from + (steps << shift) < 0);
  }

  /// The last coordinate of the point of the surface's plane that has the other two coordinates.
  std::int64_t onSlope(const Coordinates& guess, const Coordinates& normal, const Coordinates& at) const {
    std::int64_t expected = guess[2];
    if (normal[2] != 0)
      expected -= (normal[0] * (at[0] - guess[0]) + normal[1] * (at[1] - guess[1])) / normal[2];
    return std::clamp<std::int64_t>(expected, 0, maximum_);
  }

  Coder& coder_;
  Version version_;
  PositionModels models_;
  const Connectivity& connectivity_;
  Predictor predictor_;
  std::int64_t maximum_;
  const std::optional<VertexGrid>& grid_;
  CoarseResiduals residuals_;
  std::vector<Vec3u>& positions_;
  NormalSums sums_;
  std::vector<std::uint8_t> masks_;
  std::array<std::int64_t, 3> lastLines_{}; ///< of the grid, that a lattice has
  std::vector<std::uint32_t> sizes_;        ///< of residuals, per vertex; version 2
  [[no_unique_address]] std::conditional_t<Coder::encodes, std::optional<Costs>, Nothing> costs_; ///< in version 2
  std::uint32_t next_ = 0;
};

} // namespace imgeo::compact
