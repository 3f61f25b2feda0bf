#include "base/error.h"
#include "live/frame.h"

#include <cstdlib>

/// Requires that a decoded frame, whatever its prediction was, is the same after encoding and decoding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  try {
    const live::Frame frame = live::decodeFrame({data, size}, "fuzz.igf");
    if (live::decodeFrame(live::encodeFrame(frame), "again.igf") != frame)
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || error.location() != "fuzz.igf")
      std::abort();
  }
  return 0;
}
