// PLY files that follow one another. The first byte is the size of the portions in which they arrive.
#include "import/ply/frames.h"

#include "base/error.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  if (size == 0)
    return 0;
  ByteSpan rest(data + 1, size - 1);
  const std::size_t portion = 1 + std::size_t{data[0]} * data[0];
  PlyFrameReader reader([&](std::span<std::uint8_t> out) {
    const std::size_t count = std::min({portion, out.size(), rest.size()});
    std::copy_n(rest.begin(), count, out.begin());
    rest = rest.subspan(count);
    return count;
  });
  try {
    while (const auto frame = reader.next("fuzz", {}))
      if (!frame->attributes.normals.empty() && frame->attributes.normals.size() != frame->positions.size())
        std::abort();
  } catch (const Error&) {
  }
  return 0;
}
