#include "transcode/encode/group_chips.h"

#include "transcode/encode/chip_image.h"
#include "transcode/encode/chip_limits.h"
#include "transcode/encode/chip_pieces.h"
#include "transcode/encode/pack_rectangles.h"

#include <cmath>
#include <utility>

namespace imgeo {

namespace {

/// Gives each piece wedges of its own, with coordinates in the image of chips.
void rewriteWedges(Patch& patch, std::size_t set, const ChipPieces& group, const std::vector<ChipPiece>& pieces,
                   const PackedRectangles& packed) {
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> sources, newWedge(patch.wedgeCount(), none);
  std::vector<Vec2f> coords;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto [column, row] = packed.corners[i];
    const std::size_t first = sources.size();
    for (const std::uint32_t triangle : pieces[i].triangles)
      for (std::size_t corner = 3 * std::size_t{triangle}; corner < 3 * std::size_t{triangle} + 3; ++corner) {
        const std::uint32_t wedge = patch.corners[corner];
        if (newWedge[wedge] == none) {
          newWedge[wedge] = static_cast<std::uint32_t>(sources.size());
          sources.push_back(wedge);
          const TexelPoint at = group.at(wedge);
          const double x = at.x - pieces[i].rect.left + chipGutter + column,
                       y = at.y - pieces[i].rect.top + chipGutter + row;
          coords.push_back({static_cast<float>(x / packed.size.width), static_cast<float>(1 - y / packed.size.height)});
        }
        patch.corners[corner] = newWedge[wedge];
      }
    for (std::size_t wedge = first; wedge < sources.size(); ++wedge)
      newWedge[sources[wedge]] = none;
  }
  patch.wedgePositions = gather(patch.wedgePositions, sources);
  static_cast<VertexAttributes&>(patch) = gather(patch, sources);
  texCoordsOf(patch, set) = std::move(coords);
}

std::optional<PackedRectangles> packPieces(const std::vector<ChipPiece>& pieces) {
  std::vector<RasterSize> sizes;
  for (const ChipPiece& piece : pieces)
    sizes.push_back(chipSize(piece.rect));
  return packRectangles(sizes, maxChipEdge);
}

double areaOnLattice(const Patch& patch, std::size_t triangle) {
  const auto at = [&](std::size_t i) {
    return Vec3d(patch.positions[patch.wedgePositions[patch.corners[3 * triangle + i]]]);
  };
  return length(cross(at(1) - at(0), at(2) - at(0))) / 2;
}

} // namespace

std::optional<RasterSize> chipImageSize(const Patch& patch, std::uint32_t level, std::size_t set,
                                        const ChipSource& source) {
  const std::vector<ChipPiece> pieces = ChipPieces(patch, set, source, level).take();
  const std::optional<PackedRectangles> packed = packPieces(pieces);
  return packed ? std::optional(packed->size) : std::nullopt;
}

std::optional<GroupChips> makeChips(Patch& patch, std::uint32_t level, std::size_t set, const ChipSource& source) {
  ChipPieces group(patch, set, source, level);
  const std::vector<ChipPiece> pieces = group.take();
  const std::optional<PackedRectangles> packed = packPieces(pieces);
  if (!packed)
    return std::nullopt;
  GroupChips chips;
  double area = 0, texels = 0;
  for (std::uint32_t triangle = 0; triangle < patch.elementCount(); ++triangle) {
    area += areaOnLattice(patch, triangle);
    texels += group.texelArea(triangle);
  }
  chips.texelEdge = texels > 0 ? std::sqrt(area / texels) : 0;
  ChipImage image(packed->size, level, source);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    image.draw(pieces[i], packed->corners[i].first, packed->corners[i].second);
  chips.image = image.take();
  rewriteWedges(patch, set, group, pieces, *packed);
  return chips;
}

} // namespace imgeo
