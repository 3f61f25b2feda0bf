#include "import_check.h"

#include "e57_checksums.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  imgeo::fuzz::importOrRefuse(data, size, "fuzz.e57");
  const imgeo::Bytes repaired = imgeo::fuzz::withChecksums({data, size});
  return imgeo::fuzz::importOrRefuse(repaired.data(), repaired.size(), "fuzz.e57");
}
