#include "live/frame.h"
#include "live/frame_samples.h"

#include "base/error.h"

#include <functional>
#include <gtest/gtest.h>
#include <libdeflate.h>

namespace imgeo::live {
namespace {

/// The kind of error with which bytes are refused; nothing if they are a frame.
std::optional<ErrorKind> refusalOf(ByteSpan bytes) {
  try {
    decodeFrame(bytes, "test.igf");
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.location(), "test.igf");
    return error.kind();
  }
}

/// A frame after a change of its header, whose checksum is made right again.
Bytes withHeader(Bytes bytes, const std::function<void(std::uint8_t*)>& change) {
  change(bytes.data());
  const std::uint32_t sum = libdeflate_crc32(0, bytes.data(), 48);
  for (int i = 0; i < 4; ++i)
    bytes[48 + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  return bytes;
}

FrameLayout randomLayout(testing::Random& random) {
  FrameLayout layout;
  layout.columns = random() % 3 == 0 ? 0 : 1 + random() % 20;
  layout.vertices = (1 + random() % 30) * std::max(1u, layout.columns);
  layout.positionBits = 8 + random() % 17;
  layout.normalBits = random() % 2 == 0 ? 0 : 8 + random() % 9;
  layout.colorComponents = random() % 2 == 0 ? 0 : 3 + random() % 2;
  layout.valueComponents = random() % 5;
  layout.valueBits = layout.valueComponents == 0 ? 0 : 8 + random() % 17;
  return layout;
}

TEST(Frame, IsTheSameAfterEncodingAndDecoding) {
  testing::Random random(1);
  for (std::uint32_t round = 0; round < 400; ++round) {
    const FrameLayout layout = randomLayout(random);
    const Frame frame = round % 2 == 0 ? testing::smoothFrame(layout, round) : testing::noiseFrame(layout, round);
    for (const Prediction prediction :
         {Prediction::none, Prediction::previous, Prediction::linear, choosePrediction(frame)}) {
      const Bytes bytes = encodeFrame(frame, prediction);
      EXPECT_EQ(readFrameHeader(bytes, "").prediction, prediction);
      EXPECT_EQ(decodeFrame(bytes, ""), frame) << "round " << round;
    }
  }
}

TEST(Frame, PredictsExtremeValuesWithoutLoss) {
  Frame frame{{6, 3}, 0, 0, 0, {}};
  for (const std::uint32_t bits : {8u, 9u, 16u, 23u, 24u}) {
    frame.layout.positionBits = bits;
    const std::uint32_t maximum = (1u << bits) - 1;
    frame.components = {0, maximum, 0, maximum, 0, maximum, maximum, maximum, 0, 0, maximum, 0, 0, 0, 0, 0, 0, 0};
    for (const Prediction prediction : {Prediction::none, Prediction::previous, Prediction::linear, Prediction::planar})
      EXPECT_EQ(decodeFrame(encodeFrame(frame, prediction), ""), frame);
  }
}

TEST(Frame, IsCutNowhereWithoutAnError) {
  const Bytes bytes = encodeFrame(testing::smoothFrame({35, 7, 16, 8, 3, 1, 8}, 1));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(refusalOf(ByteSpan(bytes).first(size)), ErrorKind::truncated) << size;
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_EQ(refusalOf(longer), ErrorKind::malformed);
}

TEST(Frame, IsRefusedOrTheSameAfterAnyChangeOfABit) {
  const Frame frame = testing::smoothFrame({35, 7}, 1);
  const Bytes bytes = encodeFrame(frame);
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    Bytes changed = bytes;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    // Some bits have no meaning: the time and the system in the header of gzip, those behind the last block of deflate.
    if (refusalOf(changed).has_value())
      ++refused;
    else
      EXPECT_EQ(decodeFrame(changed, ""), frame) << "bit " << bit;
  }
  EXPECT_GT(refused, bytes.size() * 8 - 80);
}

TEST(Frame, StatesLimitsBeforeMemoryIsAllocated) {
  const Bytes bytes = encodeFrame(testing::smoothFrame({35, 7}, 1));
  const auto withVertices = [&](std::uint32_t vertices) {
    return withHeader(bytes, [&](std::uint8_t* header) {
      std::memset(header + 32, 0, 8);
      std::memcpy(header + 32, &vertices, 4);
      header[45] = 0;
    });
  };
  EXPECT_EQ(refusalOf(withVertices(maxFrameVertices + 1)), ErrorKind::limit);
  EXPECT_EQ(refusalOf(withVertices(maxFrameVertices)), ErrorKind::malformed) << "too few bytes for so many vertices";
  EXPECT_EQ(refusalOf(withVertices(36)), ErrorKind::malformed) << "the stream unpacks to fewer bytes";
  EXPECT_EQ(refusalOf(withVertices(34)), ErrorKind::malformed) << "the stream unpacks to more bytes";
  EXPECT_EQ(refusalOf(withVertices(0)), ErrorKind::malformed);
  // 2^22 vertices with every attribute have more than 64 MiB.
  EXPECT_THROW(checkLayout({maxFrameVertices, 0, 24, 16, 4, 4, 24}, ""), Error);
}

/// A frame of one layout whose coordinates are v(i).
template <typename Value> Frame frameOf(const FrameLayout& layout, const Value& v) {
  Frame frame{layout, 0, 0, 0, {}};
  for (int axis = 0; axis < 3; ++axis)
    for (std::uint32_t i = 0; i < layout.vertices; ++i)
      frame.components.push_back(v(i) & 0xffff);
  return frame;
}

TEST(Frame, OfACurvedGridIsSmallestWithPlanarPrediction) {
  const Frame frame = frameOf({4096, 64}, [](std::uint32_t i) { return i % 64 * (i % 64) + 3 * (i / 64) * (i / 64); });
  const std::size_t planar = encodeFrame(frame).size();
  EXPECT_EQ(choosePrediction(frame), Prediction::planar);
  for (const Prediction other : {Prediction::none, Prediction::previous, Prediction::linear})
    EXPECT_LT(planar, encodeFrame(frame, other).size());
}

TEST(Frame, WithoutAGridHasThePredictionWithTheSmallestResiduals) {
  const FrameLayout points{4096, 0};
  EXPECT_EQ(choosePrediction(testing::noiseFrame(points, 1)), Prediction::none);
  testing::Random random(2);
  std::uint32_t walk = 0;
  EXPECT_EQ(choosePrediction(frameOf(points, [&](std::uint32_t) { return walk += random() % 101 - 50; })),
            Prediction::previous);
  EXPECT_EQ(choosePrediction(frameOf(points, [](std::uint32_t i) { return i * 5; })), Prediction::linear);
}

} // namespace
} // namespace imgeo::live
