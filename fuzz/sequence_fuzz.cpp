#include "base/error.h"
#include "sequence/sequence_file.h"

#include <cstdlib>
#include <cstring>

/// The bytes are an index, a zero byte, and its first file. Requires that an index that is read is the same after it
/// has been written, and that decoded frames are the same after encoding and decoding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  const void* end = size == 0 ? nullptr : std::memchr(data, 0, size);
  const std::size_t indexSize = end ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(end) - data) : size;
  try {
    const SequenceIndex index = readSequenceIndex({reinterpret_cast<const char*>(data), indexSize}, "fuzz");
    if (readSequenceIndex(writeSequenceIndex(index), "again") != index)
      std::abort();
    std::vector<live::Frame> frames;
    const ByteSpan file{data + std::min(size, indexSize + 1), size - std::min(size, indexSize + 1)};
    decodeSequenceFile(file, index, 0, "fuzz", [&](const live::Frame& frame) { frames.push_back(frame); });
    const Bytes bytes = encodeSequenceFile(frames, 1);
    std::size_t same = 0;
    decodeSequenceFile(bytes, index, 0, "again",
                       [&](const live::Frame& frame) { same += frame == frames.at(frame.number); });
    if (same != frames.size())
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || !error.location().starts_with("fuzz"))
      std::abort();
  }
  return 0;
}
