#include "base/error.h"
#include "video/sequence_video.h"

#include <algorithm>
#include <cstdlib>

/// The bytes are a WebM file. Reads it and decodes its images as frames of the sequence of the corpus. Requires that
/// the packets that are read are the same after they have been written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  SequenceIndex index;
  index.description.layout = {35, 7};
  index.description.rate = 25;
  index.description.box = {{0, 0, 0}, {1, 1, 1}};
  index.files = {{"a.igf", 4, 1}};
  try {
    const WebmVideo video = readWebm({data, size}, "fuzz");
    std::vector<Bytes> packets;
    for (const VideoPacket& packet : video.packets)
      packets.emplace_back(packet.bytes.begin(), packet.bytes.end());
    const Bytes again = writeWebm(video.size, packets, 25);
    const WebmVideo read = readWebm(again, "again");
    if (read.size != video.size || read.packets.size() != packets.size())
      std::abort();
    for (std::size_t i = 0; i < packets.size(); ++i)
      if (!std::ranges::equal(read.packets[i].bytes, packets[i]))
        std::abort();
    decodeVideoFrames({data, size}, index, 0, 4, "fuzz", [](const live::Frame&) {});
  } catch (const Error& error) {
    if (error.message().empty() || error.location() != "fuzz")
      std::abort();
  }
  return 0;
}
