#include "import_check.h"

#include "e57_checksums.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  imgeo::fuzz::importOrRefuse({data, size}, "fuzz.e57");
  return imgeo::fuzz::importOrRefuse(imgeo::fuzz::withChecksums({data, size}), "fuzz.e57");
}
