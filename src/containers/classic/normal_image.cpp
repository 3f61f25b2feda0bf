#include "containers/classic/normal_image.h"

#include "base/error.h"
#include "containers/normal_palette.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

Image rgbImage(const IndexedPatch& patch, ImageSize records) {
  return imageOf(records, 3, patch.vertexCount(), [&](std::size_t n, std::uint8_t* out) {
    for (int axis = 0; axis < 3; ++axis) {
      const double component = std::clamp(double{patch.normals[n][axis]}, -1.0, 1.0);
      out[axis] = static_cast<std::uint8_t>((component + 1) * 127.5 + 0.5);
    }
  });
}

/// Stores the two numbers of every normal in the first and the second half of a gray image. RGB with a constant channel
/// would be larger (docs/decisions/normals.md), and browsers multiply gray by alpha.
Image pairImage(const IndexedPatch& patch, NormalEncoding encoding, ImageSize records) {
  const ImageSize size = pairImageSize(records);
  if (size.columns > guaranteedImageEdge)
    throw Error(ErrorKind::limit, "",
                "normals of two numbers fit into an image for at most 2,097,152 vertices; use smaller patches");
  Image image{size.columns, size.rows, 1, Bytes(std::size_t{size.columns} * size.rows)};
  const std::size_t half = image.pixels.size() / 2, count = patch.vertexCount();
  for (std::size_t n = 0; n < count; ++n) {
    const Vec2<std::uint32_t> stored = storeNormal(patch.normals[n], encoding, 8);
    image.pixels[n] = static_cast<std::uint8_t>(stored.x);
    image.pixels[half + n] = static_cast<std::uint8_t>(stored.y);
  }
  for (const std::size_t begin : {std::size_t{0}, half})
    std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(begin + count), half - count,
                image.pixels[begin + count - 1]);
  return image;
}

/// An indexed image whose palette has only the entries that normals use.
Image paletteImage(const IndexedPatch& patch, ImageSize records) {
  const NormalPalette palette = normalPalette(patch.normals);
  std::array<std::uint8_t, 256> entryOf{};
  std::array<bool, 256> used{};
  for (const std::uint8_t index : palette.indices)
    used[index] = true;
  Bytes entries;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) {
      entryOf[i] = static_cast<std::uint8_t>(entries.size() / 3);
      entries.insert(entries.end(), {palette.colors[i].r, palette.colors[i].g, palette.colors[i].b});
    }
  Image image = imageOf(records, 1, patch.vertexCount(),
                        [&](std::size_t n, std::uint8_t* out) { out[0] = entryOf[palette.indices[n]]; });
  image.palette = std::move(entries);
  return image;
}

} // namespace

Image normalImage(const IndexedPatch& patch, NormalEncoding encoding, ImageSize records) {
  if (isPair(encoding))
    return pairImage(patch, encoding, records);
  return encoding == NormalEncoding::palette ? paletteImage(patch, records) : rgbImage(patch, records);
}

Vec3f normalOf(const std::uint8_t* texel) {
  return unitNormal(Vec3d{texel[0] / 127.5 - 1, texel[1] / 127.5 - 1, texel[2] / 127.5 - 1});
}

double paletteErrorOf(const IndexedPatch& patch, const Image& image) {
  double worst = 0;
  for (std::size_t n = 0; n < patch.vertexCount(); ++n)
    worst = std::max(worst, angleBetween(patch.normals[n], normalOf(&image.palette[std::size_t{3} * image.pixels[n]])));
  return worst;
}

} // namespace imgeo
