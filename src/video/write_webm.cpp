#include "base/error.h"
#include "video/webm.h"
#include "video/webm_ids.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

using namespace webm;

constexpr double millisecondsPerSecond = 1000;

/// An element under construction: its content, or itself.
class ElementBytes {
public:
  const Bytes& bytes() const { return bytes_; }

  ElementBytes& add(Id id, ByteSpan content) {
    addId(id);
    addSize(content.size());
    bytes_.insert(bytes_.end(), content.begin(), content.end());
    return *this;
  }
  ElementBytes& add(Id id, const ElementBytes& content) { return add(id, content.bytes_); }
  ElementBytes& add(Id id, std::string_view text) { return add(id, asBytes(text)); }
  /// Eight bytes, so that sizes do not depend on numbers.
  ElementBytes& add(Id id, std::uint64_t number) {
    Bytes content;
    appendBig(content, number);
    return add(id, content);
  }
  ElementBytes& add(Id id, double number) { return add(id, std::bit_cast<std::uint64_t>(number)); }

private:
  void addId(std::uint32_t id) {
    for (int shift = 24; shift >= 0; shift -= 8)
      if (id >> shift != 0)
        bytes_.push_back(static_cast<std::uint8_t>(id >> shift));
  }
  /// Four bytes for sizes below 2^28 - 1, eight for others.
  void addSize(std::uint64_t size) {
    if (size < 0x0FFFFFFF)
      appendBig(bytes_, static_cast<std::uint32_t>(0x10000000 | size));
    else
      appendBig(bytes_, std::uint64_t{1} << 56 | size);
  }

  Bytes bytes_;
};

ElementBytes headOf() {
  ElementBytes head;
  head.add(ebmlVersion, std::uint64_t{1})
      .add(ebmlReadVersion, std::uint64_t{1})
      .add(ebmlMaxIdLength, std::uint64_t{4})
      .add(ebmlMaxSizeLength, std::uint64_t{8})
      .add(docType, std::string_view("webm"))
      .add(docTypeVersion, std::uint64_t{4})
      .add(docTypeReadVersion, std::uint64_t{2});
  return head;
}

ElementBytes infoOf(double seconds) {
  ElementBytes info;
  info.add(timestampScale, std::uint64_t{1'000'000}) // nanoseconds
      .add(duration, seconds * millisecondsPerSecond)
      .add(muxingApp, std::string_view("imgeo"))
      .add(writingApp, std::string_view("imgeo"));
  return info;
}

/// RGB of full range (ITU-T H.273: matrix 0), so that no player converts it.
ElementBytes trackOf(VideoSize size) {
  ElementBytes colours;
  colours.add(matrixCoefficients, std::uint64_t{0})
      .add(range, std::uint64_t{2})
      .add(transferCharacteristics, std::uint64_t{13})
      .add(primaries, std::uint64_t{1});
  ElementBytes picture;
  picture.add(pixelWidth, std::uint64_t{size.width}).add(pixelHeight, std::uint64_t{size.height}).add(colour, colours);
  ElementBytes track;
  track.add(trackNumber, std::uint64_t{1})
      .add(trackUid, std::uint64_t{1})
      .add(trackType, std::uint64_t{1})
      .add(flagLacing, std::uint64_t{0})
      .add(codecId, std::string_view("V_VP9"))
      .add(video, picture);
  return track;
}

struct Cluster {
  std::uint64_t time = 0; ///< milliseconds
  ElementBytes element;
};

/// The packets in clusters, each of which begins with one that stands alone.
std::vector<Cluster> clustersOf(std::span<const Bytes> packets, double rate) {
  std::vector<Cluster> clusters;
  ElementBytes content;
  const auto finish = [&] {
    if (!clusters.empty())
      clusters.back().element.add(cluster, content);
  };
  constexpr std::uint64_t maxOffset = 32767; // a signed integer of 16 bits
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const auto time = static_cast<std::uint64_t>(std::llround(millisecondsPerSecond * static_cast<double>(i) / rate));
    const bool isKey = isKeyPacket(packets[i]).value_or(false);
    if (isKey || clusters.empty() || time - clusters.back().time > maxOffset) {
      finish();
      clusters.push_back({time, {}});
      content = ElementBytes();
      content.add(timestamp, time);
    }
    Bytes block = {0x81}; // track 1
    appendBig(block, static_cast<std::uint16_t>(time - clusters.back().time));
    block.push_back(isKey ? 0x80 : 0);
    block.insert(block.end(), packets[i].begin(), packets[i].end());
    content.add(simpleBlock, block);
  }
  finish();
  return clusters;
}

/// Where clusters are, from the first byte of the segment's content. `first`: where the first is.
ElementBytes cuesOf(const std::vector<Cluster>& clusters, std::uint64_t first) {
  ElementBytes all;
  for (const Cluster& each : clusters) {
    ElementBytes position;
    position.add(cueTrack, std::uint64_t{1}).add(cueClusterPosition, first);
    ElementBytes point;
    point.add(cueTime, each.time).add(cueTrackPositions, position);
    all.add(cuePoint, point);
    first += each.element.bytes().size();
  }
  ElementBytes element;
  element.add(cues, all);
  return element;
}

} // namespace

Bytes writeWebm(VideoSize size, std::span<const Bytes> packets, double rate) {
  assert(!packets.empty());
  const std::vector<Cluster> clusters = clustersOf(packets, rate);
  ElementBytes track;
  track.add(trackEntry, trackOf(size));
  ElementBytes start;
  start.add(info, infoOf(static_cast<double>(packets.size()) / rate)).add(tracks, track);
  // Players seek by the cues, which stand before what they point at; their size is the same with any numbers.
  const std::uint64_t cuesSize = cuesOf(clusters, 0).bytes().size();
  const ElementBytes cuePoints = cuesOf(clusters, start.bytes().size() + cuesSize);
  Bytes content = start.bytes();
  content.insert(content.end(), cuePoints.bytes().begin(), cuePoints.bytes().end());
  for (const Cluster& each : clusters)
    content.insert(content.end(), each.element.bytes().begin(), each.element.bytes().end());
  ElementBytes file;
  file.add(ebml, headOf()).add(segment, content);
  if (file.bytes().size() > maxVideoBytes)
    throw Error(ErrorKind::limit, "",
                fmt::format("the video has {} bytes; at most {} are read. A sequence has no such limit",
                            file.bytes().size(), maxVideoBytes));
  return file.bytes();
}

} // namespace imgeo
