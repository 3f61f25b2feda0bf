#include "base/error.h"
#include "import/archive/zip.h"

#include <cstdlib>

/// Requires that only archives that unpack to some bytes are refused as too large, and that others are unpacked or
/// refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  const std::uint64_t unpacked = unpackedZipBytes({data, size});
  try {
    refuseZipBomb({data, size}, "fuzz.3mf");
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::limit || unpacked == 0)
      std::abort();
  }
  try {
    static_cast<void>(unpackZip({data, size}, "fuzz.amf"));
  } catch (const Error&) { // refused
  }
  return 0;
}
