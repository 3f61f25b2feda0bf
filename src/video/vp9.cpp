#include "video/vp9.h"

#include "base/error.h"

#include <cassert>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <vpx/vp8cx.h>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>
#include <vpx/vpx_encoder.h>

namespace imgeo {

namespace {

/// The planes of an RGB image: libvpx has green, blue, red.
constexpr std::size_t channelOfPlane[] = {1, 2, 0};

/// libvpx fails only where memory is short, or where this file is wrong.
void require(vpx_codec_err_t result, const char* step) {
  if (result != VPX_CODEC_OK)
    throw Error(ErrorKind::limit, "",
                fmt::format("the video cannot be encoded ({}: {})", step, vpx_codec_err_to_string(result)));
}

} // namespace

struct Vp9Encoder::State {
  VideoSize size;
  vpx_codec_ctx_t codec{};
  vpx_image_t image{};
  Bytes planes;
  vpx_codec_pts_t next = 0;
};

Vp9Encoder::Vp9Encoder(VideoSize size, int speed) {
  std::unique_ptr<State> state(new State{size, {}, {}, {}, 0}); // until nothing can fail
  vpx_codec_enc_cfg_t options;
  require(vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &options, 0), "options");
  options.g_profile = 1;
  options.g_w = size.width;
  options.g_h = size.height;
  options.g_timebase = {1, 30};
  options.g_lag_in_frames = 0; // a packet for each image
  options.g_threads = 1;
  options.kf_mode = VPX_KF_DISABLED; // the first is one
  options.rc_min_quantizer = options.rc_max_quantizer = 0;
  require(vpx_codec_enc_init(&state->codec, vpx_codec_vp9_cx(), &options, 0), "start");
  vpx_codec_control(&state->codec, VP9E_SET_LOSSLESS, 1u);
  vpx_codec_control(&state->codec, VP9E_SET_COLOR_SPACE, static_cast<int>(VPX_CS_SRGB));
  vpx_codec_control(&state->codec, VP9E_SET_COLOR_RANGE, static_cast<int>(VPX_CR_FULL_RANGE));
  vpx_codec_control(&state->codec, VP8E_SET_CPUUSED, speed);
  state->planes.resize(std::size_t{3} * size.width * size.height);
  vpx_img_wrap(&state->image, VPX_IMG_FMT_I444, size.width, size.height, 1, state->planes.data());
  state->image.cs = VPX_CS_SRGB;
  state->image.range = VPX_CR_FULL_RANGE;
  state_ = state.release();
}

Vp9Encoder::~Vp9Encoder() {
  vpx_codec_destroy(&state_->codec);
  delete state_;
}

Bytes Vp9Encoder::encode(ByteSpan pixels) {
  const std::size_t count = std::size_t{state_->size.width} * state_->size.height;
  assert(pixels.size() == 3 * count);
  for (std::size_t plane = 0; plane < 3; ++plane)
    for (std::size_t i = 0; i < count; ++i)
      state_->planes[plane * count + i] = pixels[3 * i + channelOfPlane[plane]];
  require(vpx_codec_encode(&state_->codec, &state_->image, state_->next++, 1, 0, VPX_DL_GOOD_QUALITY), "image");
  Bytes packet;
  vpx_codec_iter_t iterator = nullptr;
  while (const vpx_codec_cx_pkt_t* output = vpx_codec_get_cx_data(&state_->codec, &iterator))
    if (output->kind == VPX_CODEC_CX_FRAME_PKT) {
      const auto* data = static_cast<const std::uint8_t*>(output->data.frame.buf);
      packet.insert(packet.end(), data, data + output->data.frame.sz);
    }
  assert(!packet.empty());
  return packet;
}

struct Vp9Decoder::State {
  VideoSize size;
  std::string location;
  vpx_codec_ctx_t codec{};

  /// Bytes of the largest image that may be decoded, with the borders that libvpx adds to it.
  std::size_t maxImageBytes() const {
    constexpr std::size_t border = 2 * 160 + 64;
    return 3 * (size.width + border) * (size.height + border) + 4096;
  }

  static int takeBuffer(void* context, std::size_t bytes, vpx_codec_frame_buffer_t* buffer) {
    const auto* state = static_cast<const State*>(context);
    if (bytes > state->maxImageBytes())
      return -1;
    buffer->data = static_cast<std::uint8_t*>(std::calloc(bytes, 1));
    buffer->size = bytes;
    buffer->priv = buffer->data;
    return buffer->data ? 0 : -1;
  }

  static int giveBufferBack(void*, vpx_codec_frame_buffer_t* buffer) {
    std::free(buffer->priv);
    buffer->priv = buffer->data = nullptr;
    return 0;
  }
};

Vp9Decoder::Vp9Decoder(VideoSize size, std::string location) {
  std::unique_ptr<State> state(new State{size, std::move(location), {}}); // until nothing can fail
  require(vpx_codec_dec_init(&state->codec, vpx_codec_vp9_dx(), nullptr, 0), "decoder");
  require(vpx_codec_set_frame_buffer_functions(&state->codec, &State::takeBuffer, &State::giveBufferBack, state.get()),
          "memory of the decoder");
  state_ = state.release();
}

Vp9Decoder::~Vp9Decoder() {
  vpx_codec_destroy(&state_->codec);
  delete state_;
}

Bytes Vp9Decoder::decode(const VideoPacket& packet, std::uint32_t number) {
  const auto fail = [&](ErrorKind kind, const std::string& message) { throw Error(kind, state_->location, message); };
  const std::uint8_t* data = packet.bytes.data();
  const auto size = static_cast<unsigned>(packet.bytes.size());
  vpx_codec_stream_info_t info{};
  info.sz = sizeof info;
  if (packet.isKey && (vpx_codec_peek_stream_info(vpx_codec_vp9_dx(), data, size, &info) != VPX_CODEC_OK ||
                       info.w != state_->size.width || info.h != state_->size.height))
    fail(ErrorKind::malformed, fmt::format("image {} has another size than its file states", number));
  if (vpx_codec_decode(&state_->codec, data, size, nullptr, 0) != VPX_CODEC_OK)
    fail(ErrorKind::malformed, fmt::format("image {} cannot be decoded", number));
  vpx_codec_iter_t iterator = nullptr;
  const vpx_image_t* image = vpx_codec_get_frame(&state_->codec, &iterator);
  if (!image || image->d_w != state_->size.width || image->d_h != state_->size.height)
    fail(ErrorKind::malformed, fmt::format("image {} has another size than its file states", number));
  if (image->fmt != VPX_IMG_FMT_I444 || image->cs != VPX_CS_SRGB)
    fail(ErrorKind::unsupported, fmt::format("image {} is no RGB: its colours would be converted", number));
  Bytes pixels(std::size_t{3} * state_->size.width * state_->size.height);
  for (std::size_t plane = 0; plane < 3; ++plane)
    for (std::uint32_t y = 0; y < state_->size.height; ++y) {
      const std::uint8_t* in = image->planes[plane] + std::ptrdiff_t{image->stride[plane]} * y;
      std::uint8_t* out = pixels.data() + std::size_t{3} * state_->size.width * y + channelOfPlane[plane];
      for (std::uint32_t x = 0; x < state_->size.width; ++x)
        out[std::size_t{3} * x] = in[x];
    }
  return pixels;
}

} // namespace imgeo
