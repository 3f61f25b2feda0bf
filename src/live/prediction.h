#pragma once
// Residuals of predicted integers: docs/formats/frame.md, "Values".

#include "live/frame.h"

namespace imgeo::live {

/// The residual of every value, with the sign in the lowest bit. `columns` is the length of a row; only planar
/// prediction uses it. `residuals` has as many elements as `values`, which are less than 2^bits.
void residualsOf(std::span<const std::uint32_t> values, Prediction prediction, std::uint32_t columns,
                 std::uint32_t bits, std::span<std::uint32_t> residuals);

/// Replaces residuals by their values.
void restoreValues(std::span<std::uint32_t> residuals, Prediction prediction, std::uint32_t columns,
                   std::uint32_t bits);

} // namespace imgeo::live
