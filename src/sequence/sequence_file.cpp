#include "sequence/sequence_file.h"

#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

using live::Prediction;

/// Predictions are compared at this level.
constexpr int probingLevel = 1;

/// Replaces `best` by a candidate that is shorter.
void keepShorter(Bytes& best, Bytes candidate) {
  if (candidate.size() < best.size())
    best = std::move(candidate);
}

/// A frame in the shortest way. `before`: nullptr for a key frame.
Bytes encodeShortest(const live::Frame& frame, const live::Frame* before, int level) {
  const Prediction alone = live::choosePrediction(frame);
  Bytes shortest = live::encodeFrame(frame, alone, probingLevel);
  Prediction ofDifference = Prediction::none;
  bool isDifference = false;
  if (before != nullptr)
    for (const Prediction prediction : {Prediction::none, Prediction::previous, Prediction::planar}) {
      if (prediction == Prediction::planar && frame.layout.columns == 0)
        continue;
      Bytes difference = live::encodeDifference(frame, *before, prediction, probingLevel);
      if (difference.size() >= shortest.size())
        continue;
      shortest = std::move(difference);
      ofDifference = prediction;
      isDifference = true;
    }
  if (level != probingLevel)
    keepShorter(shortest, isDifference ? live::encodeDifference(frame, *before, ofDifference, level)
                                       : live::encodeFrame(frame, alone, level));
  return shortest;
}

/// The bytes of the frame with which `bytes` begin: its header says how many there are.
ByteSpan firstFrameIn(ByteSpan bytes, const std::string& location) {
  if (bytes.size() < live::frameHeaderBytes)
    throw Error(ErrorKind::truncated, location, "the file ends before the frame");
  const std::uint64_t size = std::uint64_t{live::frameHeaderBytes} + loadLittle<std::uint32_t>(bytes.data() + 4);
  return bytes.first(std::min<std::uint64_t>(size, bytes.size()));
}

void checkFrame(const live::Frame& frame, const SequenceIndex& index, std::uint32_t number,
                const std::string& location) {
  if (frame.number != number || frame.epoch != 0)
    throw Error(ErrorKind::malformed, location, fmt::format("has the number {}", frame.number));
  if (frame.layout != index.description.layout)
    throw Error(ErrorKind::malformed, location, "has other vertices or attributes than the sequence");
}

} // namespace

Bytes encodeSequenceFile(std::span<const live::Frame> frames, int compressionLevel) {
  Bytes bytes;
  const live::Frame* before = nullptr;
  for (const live::Frame& frame : frames) {
    const Bytes encoded = encodeShortest(frame, before, compressionLevel);
    bytes.insert(bytes.end(), encoded.begin(), encoded.end());
    before = &frame;
  }
  return bytes;
}

void decodeSequenceFile(ByteSpan bytes, const SequenceIndex& index, std::size_t file, const std::string& location,
                        const std::function<void(const live::Frame&)>& visit, std::uint32_t end) {
  const std::uint32_t first = index.firstFrameOf(file), count = index.files[file].frames;
  live::Frame before;
  for (std::uint32_t i = 0; i < count && first + i < end; ++i) {
    const std::string frameLocation = fmt::format("{}, frame {}", location, first + i);
    const ByteSpan encoded = firstFrameIn(bytes, frameLocation);
    live::Frame frame = live::decodeFrame(encoded, i > 0 ? &before : nullptr, frameLocation);
    checkFrame(frame, index, first + i, frameLocation);
    bytes = bytes.subspan(encoded.size());
    visit(frame);
    before = std::move(frame);
  }
  if (first + count <= end && !bytes.empty())
    throw Error(ErrorKind::malformed, location, "bytes follow the last frame");
}

} // namespace imgeo
