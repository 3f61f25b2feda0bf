#pragma once
// Draws the chips of a group.

#include "transcode/encode/chip_pieces.h"

#include <cstdint>
#include <vector>

namespace imgeo {

class ChipImage {
public:
  ChipImage(RasterSize size, std::uint32_t level, const ChipSource& source);

  /// Draws a piece into the rectangle of its chip, whose first pixel is at (column, row).
  void draw(const ChipPiece& piece, std::uint32_t column, std::uint32_t row);

  Raster take() { return std::move(image_); }

private:
  std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) {
    return &image_.pixels[4 * (std::size_t{y} * image_.width + x)];
  }

  template <typename IsCovered>
  bool drawTexels(const TexelRect& rect, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row,
                  IsCovered isCovered);
  template <typename IsCovered>
  bool drawTexel(std::uint32_t x, std::uint32_t y, std::uint8_t* pixel, IsCovered isCovered) const;
  void drawNearest(const ChipPiece& piece, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row);
  void fillOutwards(RasterSize size, std::uint32_t column, std::uint32_t row);

  std::uint32_t level_;
  const ChipSource& source_;
  Raster image_;
  std::vector<bool> isDrawn_; ///< texels of the chip that is drawn
};

} // namespace imgeo
