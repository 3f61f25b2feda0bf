#include "containers/classic/attribute_images.h"

#include "base/error.h"
#include "containers/normal_palette.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// The largest number of `bits` bits.
std::uint32_t largestOf(std::uint32_t bits) {
  return (1u << bits) - 1;
}

/// The number of `bits` bits that is nearest to a fraction.
std::uint32_t storeFraction(double fraction, std::uint32_t bits) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * largestOf(bits)));
}

/// Byte `plane` of a number, counted from the least significant.
std::uint8_t byteOf(std::uint32_t number, std::uint32_t plane) {
  return static_cast<std::uint8_t>(number >> (8 * plane));
}

/// Makes images of records of which store(n, component) gives numbers of `bits` bits: one image for each byte.
template <typename Store>
std::vector<Image> byteImages(std::size_t count, std::uint32_t components, std::uint32_t bits, ImageSize records,
                              Store store) {
  std::vector<Image> images;
  for (std::uint32_t plane = bits / 8; plane-- > 0;)
    images.push_back(imageOf(records, components, count, [&](std::size_t n, std::uint8_t* out) {
      for (std::uint32_t c = 0; c < components; ++c)
        out[c] = byteOf(store(n, c), plane);
    }));
  return images;
}

/// Makes an image of pairs of two bytes each: red and blue are the bytes of the first number, green and alpha those of
/// the second.
template <typename Pair> Image wordPairImage(std::size_t count, ImageSize records, Pair pair) {
  return imageOf(records, 4, count, [&](std::size_t n, std::uint8_t* out) {
    const Vec2<std::uint32_t> words = pair(n);
    out[0] = byteOf(words.x, 1);
    out[1] = byteOf(words.y, 1);
    out[2] = byteOf(words.x, 0);
    out[3] = byteOf(words.y, 0);
  });
}

std::vector<Image> rgbImages(const IndexedPatch& patch, std::uint32_t bits, ImageSize records) {
  return byteImages(patch.vertexCount(), 3, bits, records, [&](std::size_t n, std::uint32_t axis) {
    return storeFraction((double{patch.normals[n][static_cast<int>(axis)]} + 1) / 2, bits);
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

std::vector<Image> normalImages(const IndexedPatch& patch, const GeometryDescription& geometry, ImageSize records) {
  const NormalEncoding encoding = geometry.normalEncoding;
  const std::uint32_t bits = geometry.imageBits[VertexRole::normal];
  std::vector<Image> images;
  if (encoding == NormalEncoding::palette)
    images.push_back(paletteImage(patch, records));
  else if (!isPair(encoding))
    return rgbImages(patch, bits, records);
  else if (bits == 8)
    images.push_back(pairImage(patch, encoding, records));
  else
    images.push_back(wordPairImage(patch.vertexCount(), records,
                                   [&](std::size_t n) { return storeNormal(patch.normals[n], encoding, bits); }));
  return images;
}

/// 8 bits: u and v are red and green. 16 bits: a pair of words. 24 bits: these, and an image of the low bytes.
std::vector<Image> texCoordImages(const std::vector<Vec2f>& texCoords, const TexCoordBox& box, std::uint32_t bits,
                                  ImageSize records) {
  const auto pair = [&](std::size_t n) -> Vec2<std::uint32_t> {
    const Vec2<double> fraction = texCoordFraction(texCoords[n], box);
    return {storeFraction(fraction.x, bits), storeFraction(fraction.y, bits)};
  };
  std::vector<Image> images;
  if (bits > 8)
    images.push_back(wordPairImage(texCoords.size(), records, [&](std::size_t n) -> Vec2<std::uint32_t> {
      const Vec2<std::uint32_t> stored = pair(n);
      return {stored.x >> (bits - 16), stored.y >> (bits - 16)};
    }));
  if (bits != 16)
    images.push_back(imageOf(records, 3, texCoords.size(), [&](std::size_t n, std::uint8_t* out) {
      const Vec2<std::uint32_t> stored = pair(n);
      out[0] = byteOf(stored.x, 0);
      out[1] = byteOf(stored.y, 0);
      out[2] = 0;
    }));
  return images;
}

std::vector<Image> colorImages(const IndexedPatch& patch, const GeometryDescription& geometry, ImageSize records) {
  const std::uint32_t bits = geometry.imageBits[VertexRole::color];
  return byteImages(patch.vertexCount(), geometry.colorComponents, bits, records, [&](std::size_t n, std::uint32_t c) {
    const Rgba& color = patch.colors[n];
    const float channels[] = {color.r, color.g, color.b, color.a};
    return storeFraction(channels[c], bits);
  });
}

} // namespace

std::vector<Image> attributeImages(VertexRole role, const IndexedPatch& patch, const GeometryDescription& geometry,
                                   ImageSize records) {
  switch (role) {
  case VertexRole::normal:
    return normalImages(patch, geometry, records);
  case VertexRole::texCoord:
  case VertexRole::texCoord1:
  case VertexRole::texCoord2:
  case VertexRole::texCoord3: {
    const std::size_t set = texCoordSetOf(role);
    return texCoordImages(texCoordsOf(patch, set), geometry.texCoordBoxes[set], geometry.imageBits[role], records);
  }
  case VertexRole::color:
    break;
  }
  return colorImages(patch, geometry, records);
}

Vec3f normalOf(const Vec3u& stored, std::uint32_t bits) {
  const auto component = [&](std::uint32_t number) { return 2.0 * number / largestOf(bits) - 1; };
  return unitNormal(Vec3d{component(stored.x), component(stored.y), component(stored.z)});
}

double paletteErrorOf(const IndexedPatch& patch, const Image& image) {
  const auto paletteNormal = [&](std::size_t entry) {
    const std::uint8_t* color = &image.palette[3 * entry];
    return normalOf(Vec3u{color[0], color[1], color[2]}, 8);
  };
  double worst = 0;
  for (std::size_t n = 0; n < patch.vertexCount(); ++n)
    worst = std::max(worst, angleBetween(patch.normals[n], paletteNormal(image.pixels[n])));
  return worst;
}

} // namespace imgeo
