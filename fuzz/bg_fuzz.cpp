#include "containers/container_reader.h"

#include "patch_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  fuzz::InputReader input({data, size});
  const auto type = [&] { return static_cast<ElementType>(input.bits(8) % 7); };
  GeometryDescription geometry;
  geometry.encoding = Encoding::bg;
  geometry.lattice.bits = 8 + input.bits(8) % 25;
  geometry.colorComponents = 3 + input.bits(8) % 2;
  geometry.indexType = type();
  geometry.coordType = type();
  for (const VertexRole role : vertexRoles)
    geometry.attributeTypes[role] = type();
  geometry.normalEncoding = static_cast<NormalEncoding>(input.bits(8) % 4);
  const PatchDescription patch = fuzz::readDescription(input, geometry.encoding, 1);

  std::map<std::string, Bytes> files;
  for (std::size_t i = 0; i < 5; ++i) {
    const ByteSpan bytes = input.take(input.bits(16));
    files[std::to_string(i)] = Bytes(bytes.begin(), bytes.end());
  }
  return fuzz::decodeOrRefuse(patch, geometry, files);
}
