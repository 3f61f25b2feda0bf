#include "base/error.h"
#include "containers/levels/level_index.h"

#include <cstdlib>

/// The bytes are payloads of pages: two bytes with the size of each, the first the low one, and then the payload. The
/// last has what remains. Requires that an index that is read is the same after it has been written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  std::vector<Bytes> payloads;
  while (size >= 2) {
    const std::size_t stated = static_cast<std::size_t>(data[0]) + 256u * data[1];
    data += 2, size -= 2;
    const std::size_t length = stated < size ? stated : size;
    payloads.emplace_back(data, data + length);
    data += length, size -= length;
  }
  try {
    const LevelIndex index = readLevelPayloads(payloads, "fuzz.png");
    std::vector<Bytes> again;
    const std::vector<std::uint32_t> pageBytes(index.pageCount(), 1);
    for (std::size_t page = 0; page < index.pageCount(); ++page)
      again.push_back(levelPagePayload(index, page, pageBytes));
    if (readLevelPayloads(again, "again") != index)
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || !error.location().starts_with("fuzz"))
      std::abort();
  }
  return 0;
}
