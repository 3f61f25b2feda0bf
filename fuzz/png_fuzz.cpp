#include "base/error.h"
#include "containers/png/png.h"

#include <cstdlib>

/// Requires that a decoded PNG, whatever chunks it had, is the same after encoding and decoding.
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
