#pragma once
// Lossless VP9 of profile 1: RGB images of eight bits, by libvpx.

#include "video/webm.h"

namespace imgeo {

/// Encodes RGB images one after the other without loss. The first packet stands alone, the others follow one another.
class Vp9Encoder {
public:
  /// `speed`: 0 (smallest) .. 8.
  Vp9Encoder(VideoSize size, int speed);
  ~Vp9Encoder();
  Vp9Encoder(const Vp9Encoder&) = delete;
  Vp9Encoder& operator=(const Vp9Encoder&) = delete;

  /// The packet of an image. Deterministic.
  Bytes encode(ByteSpan pixels);

private:
  struct State;
  State* state_ = nullptr;
};

/// Decodes packets one after the other. Safe for untrusted bytes: images of other sizes than the stated one are refused
/// before there is memory for them.
class Vp9Decoder {
public:
  Vp9Decoder(VideoSize size, std::string location);
  ~Vp9Decoder();
  Vp9Decoder(const Vp9Decoder&) = delete;
  Vp9Decoder& operator=(const Vp9Decoder&) = delete;

  /// The pixels of packet `number`, RGB. Throws Error{malformed, unsupported}.
  Bytes decode(const VideoPacket& packet, std::uint32_t number);

private:
  struct State;
  State* state_ = nullptr;
};

} // namespace imgeo
