#include "containers/png/png.h"

#include "patch_input.h"

/// The images of a patch are made from raw pixels. Mutated PNG files would fail at their checksums in the PNG reader,
/// which has a fuzz target of its own.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  fuzz::InputReader input({data, size});
  GeometryDescription geometry;
  geometry.encoding = Encoding::classic;
  geometry.lattice.bits = 8 + input.bits(8) % 25;
  const std::uint32_t kinds = input.bits(8);
  geometry.colorComponents = 3 + kinds % 2;
  geometry.normalEncoding = static_cast<NormalEncoding>(kinds / 2 % 4);
  geometry.indexType = kinds / 8 % 2 ? ElementType::uint32 : ElementType::uint16;
  PatchDescription patch = fuzz::readDescription(input, geometry.encoding, input.bits(8) % 5);
  if (kinds & 16)
    for (const VertexRole role : vertexRoles) {
      const std::uint32_t precision = input.bits(8);
      geometry.imageBits[role] = 8 * (1 + precision % 3);
      for (std::uint32_t further = precision / 8 % 4; further > 0 && patch.vertexAttributes[role]; --further)
        patch.lowBytes[role].push_back({std::to_string(precision / 32), TexelLocation{}});
    }

  std::map<std::string, Bytes> files;
  for (std::size_t i = 0; i < 9; ++i) {
    const std::uint32_t shape = input.bits(8);
    const std::uint32_t width = shape & 1 ? 256 : 1 + input.bits(8), height = 1u << (shape / 8 % 4);
    const std::uint32_t channels = shape & 2 ? 4 : shape & 4 ? 1 : 3;
    Image image{width, height, channels, Bytes(std::size_t{width} * height * channels)};
    if (shape & 128 && channels == 1)
      image.palette.assign(3u * 200, 17);
    std::ranges::copy(input.take(std::min<std::size_t>(image.pixels.size(), 1 + input.bits(16))), image.pixels.begin());
    files[std::to_string(i)] = encodePng(image, 0);
  }
  return fuzz::decodeOrRefuse(patch, geometry, files);
}
