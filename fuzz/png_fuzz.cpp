#include "base/error.h"
#include "containers/png/png.h"

#include <cstdlib>

/// A decoded PNG survives encoding and decoding, whatever chunks it had.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  try {
    const Image image = decodePng({data, size}, "fuzz.png");
    if (decodePng(encodePng(image, 0), "again.png") != image)
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || error.location() != "fuzz.png")
      std::abort();
  }
  return 0;
}
