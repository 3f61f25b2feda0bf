#include "base/error.h"
#include "video/webm.h"
#include "video/webm_ids.h"

#include <bit>
#include <fmt/format.h>

namespace imgeo {

namespace {

using namespace webm;

constexpr std::uint64_t unknownSize = ~std::uint64_t{0};
constexpr std::size_t maxPackets = std::size_t{1} << 20;

struct Track {
  std::uint64_t number = 0, type = 0;
  std::string codec;
  std::uint64_t width = 0, height = 0;
};

/// Reads elements one behind the other. Those whose content it needs it enters, and so needs no ends of them, which
/// files that were written while they were recorded do not state.
class WebmReader {
public:
  WebmReader(ByteSpan bytes, const std::string& location) : bytes_(bytes), location_(location) {}

  WebmVideo read() {
    if (bytes_.size() > maxVideoBytes)
      fail(ErrorKind::limit, fmt::format("has {} bytes; videos of at most {} are read", bytes_.size(), maxVideoBytes));
    if (bytes_.size() < 4 || loadBig<std::uint32_t>(bytes_.data()) != ebml)
      fail(ErrorKind::malformed, "is no WebM video");
    while (at_ < bytes_.size())
      readElement();
    finishTrack();
    if (!track_)
      fail(ErrorKind::malformed, "has no video track");
    if (video_.packets.empty())
      fail(ErrorKind::truncated, "has no images");
    return std::move(video_);
  }

private:
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { throw Error(kind, location_, message); }

  /// An integer of one to eight bytes, whose leading zero bits state how many.
  std::uint64_t readNumber(std::size_t maxLength, bool keepsMarker) {
    if (at_ >= bytes_.size())
      fail(ErrorKind::truncated, "is cut");
    const auto length = static_cast<std::size_t>(std::countl_zero(bytes_[at_])) + 1;
    if (length > maxLength)
      fail(ErrorKind::malformed, fmt::format("has no element at byte {}", at_));
    if (bytes_.size() - at_ < length)
      fail(ErrorKind::truncated, "is cut");
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < length; ++i)
      number = number << 8 | bytes_[at_++];
    if (keepsMarker)
      return number;
    const std::uint64_t mask = (std::uint64_t{1} << (7 * length)) - 1;
    return (number & mask) == mask ? unknownSize : number & mask;
  }

  void readElement() {
    const auto id = static_cast<std::uint32_t>(readNumber(4, true));
    const std::uint64_t size = readNumber(8, false);
    const bool isEntered =
        id == segment || id == tracks || id == trackEntry || id == webm::video || id == cluster || id == blockGroup;
    if (size == unknownSize && !(id == segment || id == cluster))
      fail(ErrorKind::malformed, "has an element without a size");
    if (size != unknownSize && size > bytes_.size() - at_)
      fail(ErrorKind::truncated, "is cut");
    if (id == trackEntry || id == cluster)
      finishTrack();
    if (id == trackEntry)
      entry_.emplace();
    if (isEntered)
      return;
    const ByteSpan content = bytes_.subspan(at_, static_cast<std::size_t>(size));
    at_ += content.size();
    if (id == timestamp)
      clusterTime_ = integerOf(content);
    else if (id == simpleBlock || id == block)
      readBlock(content);
    else if (entry_)
      readTrackField(id, content);
  }

  std::uint64_t integerOf(ByteSpan content) const {
    if (content.size() > 8)
      fail(ErrorKind::malformed, "has a number of more than eight bytes");
    std::uint64_t number = 0;
    for (const std::uint8_t byte : content)
      number = number << 8 | byte;
    return number;
  }

  void readTrackField(std::uint32_t id, ByteSpan content) {
    if (id == trackNumber)
      entry_->number = integerOf(content);
    else if (id == trackType)
      entry_->type = integerOf(content);
    else if (id == codecId)
      entry_->codec = asText(content.first(std::min<std::size_t>(content.size(), 32)));
    else if (id == pixelWidth)
      entry_->width = integerOf(content);
    else if (id == pixelHeight)
      entry_->height = integerOf(content);
  }

  /// The first video of the file is the one that is read.
  void finishTrack() {
    if (entry_ && entry_->type == 1 && !track_) {
      if (entry_->codec != "V_VP9")
        fail(ErrorKind::unsupported, "is no VP9: only lossless VP9 is read");
      if (entry_->width == 0 || entry_->height == 0)
        fail(ErrorKind::malformed, "has images without a size");
      if (entry_->width > maxVideoEdge || entry_->height > maxVideoEdge)
        fail(ErrorKind::limit, fmt::format("has images of {} x {} pixels; at most {} x {} are read", entry_->width,
                                           entry_->height, maxVideoEdge, maxVideoEdge));
      video_.size = {static_cast<std::uint32_t>(entry_->width), static_cast<std::uint32_t>(entry_->height)};
      track_ = entry_->number;
    }
    entry_.reset();
  }

  void readBlock(ByteSpan content) {
    if (content.size() < 4 || (content[0] & 0x80) == 0)
      fail(ErrorKind::malformed, "has an image without a track");
    if (!track_ || (content[0] & 0x7f) != *track_)
      return;
    if ((content[3] & 0x06) != 0)
      fail(ErrorKind::unsupported, "has several images in a block");
    if (video_.packets.size() == maxPackets)
      fail(ErrorKind::limit, fmt::format("has more than {} images", maxPackets));
    const ByteSpan packet = content.subspan(4);
    const std::optional<bool> isKey = isKeyPacket(packet);
    if (!isKey)
      fail(ErrorKind::unsupported,
           fmt::format("has no VP9 of profile 1, which has RGB, in image {}", video_.packets.size()));
    const auto offset = static_cast<std::int16_t>(loadBig<std::uint16_t>(content.data() + 1));
    video_.packets.push_back({packet, *isKey, (static_cast<double>(clusterTime_) + offset) / 1000});
  }

  ByteSpan bytes_;
  const std::string& location_;
  std::size_t at_ = 0;
  std::optional<Track> entry_;
  std::optional<std::uint64_t> track_; ///< the number of the video that is read
  std::uint64_t clusterTime_ = 0;      ///< milliseconds
  WebmVideo video_;
};

} // namespace

std::optional<bool> isKeyPacket(ByteSpan packet) {
  // VP9 bitstream specification, 6.2: frame marker 2, profile 1, no show_existing_frame, frame type.
  if (packet.empty() || (packet[0] & 0xf8) != 0xa0)
    return {};
  return (packet[0] & 0x04) == 0;
}

WebmVideo readWebm(ByteSpan bytes, const std::string& location) {
  return WebmReader(bytes, location).read();
}

} // namespace imgeo
