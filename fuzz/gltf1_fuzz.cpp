#include "base/error.h"
#include "import/gltf/gltf1.h"

#include <cstdlib>

/// Fuzzes jsonOfGlb1: a GLB file of glTF 1.0 is refused with its name, or gives a JSON object.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  try {
    if (!jsonOfGlb1({data, size}, "fuzz.glb").starts_with('{'))
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || !error.location().starts_with("fuzz.glb"))
      std::abort();
  }
  return 0;
}
