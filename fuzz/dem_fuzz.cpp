#include "import_check.h"

/// GDAL tells the format by the content: the extension is that of a format that few bytes resemble.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return imgeo::fuzz::importOrRefuse(data, size, "fuzz.dem");
}
