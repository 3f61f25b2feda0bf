#pragma once
// Cuts the triangles of a group into pieces, of each of which the image of the group has a chip.

#include "prepare/patches.h"
#include "transcode/encode/chart_masks.h"
#include "transcode/encode/chip_source.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Triangles of one chart, and the texels around them.
struct ChipPiece {
  std::uint32_t chart = 0;
  std::vector<std::uint32_t> triangles;
  TexelRect rect; ///< in texels of the level
};

/// The size of the chip of a piece, with its gutter.
RasterSize chipSize(const TexelRect& rect);

class ChipPieces {
public:
  /// `set`: the set of texture coordinates that states the chart of each wedge.
  ChipPieces(const Patch& patch, std::size_t set, const ChipSource& source, std::uint32_t level);

  std::vector<ChipPiece> take();

  /// In texels of the level.
  TexelPoint at(std::uint32_t wedge) const { return points_[wedge]; }

  double texelArea(std::uint32_t triangle) const;

private:
  std::array<TexelPoint, 3> pointsOf(std::uint32_t triangle) const;
  TexelPoint pointOf(std::uint32_t wedge, const ChipSource& source) const;
  std::uint32_t chartOfWedge(std::uint32_t wedge) const;
  TexelRect rectOf(std::span<const std::uint32_t> triangles) const;
  void add(ChipPiece piece);
  bool divide(const ChipPiece& piece);

  const Patch& patch_;
  std::size_t set_;
  double width_, height_;          ///< of the source in texels of the level
  std::vector<TexelPoint> points_; ///< by wedge, in texels of the level
  std::vector<ChipPiece> pieces_;
};

} // namespace imgeo
