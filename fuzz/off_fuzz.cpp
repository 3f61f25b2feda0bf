#include "import_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return imgeo::fuzz::importOrRefuse(data, size, "fuzz.off");
}
