#include "containers/webp/webp.h"

#include "base/error.h"

#include <cstdlib>

/// Requires that a decoded WebP is the same after encoding and decoding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  try {
    const Image image = decodeWebp({data, size}, "fuzz.webp");
    if (image.pixels.size() <= 65536 && decodeWebp(encodeWebp(image, 0), "again.webp") != image)
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || error.location() != "fuzz.webp")
      std::abort();
  }
  return 0;
}
