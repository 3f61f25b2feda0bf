#include "live/stream.h"
#include "live/streams.h"

#include "base/error.h"
#include "live/frame_samples.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo::live {
namespace {

Description description() {
  return {{6, 3}, {{0, 0, 0}, {1, 2, 3}}, {}, 0};
}

std::size_t add(Stream& stream) {
  Frame frame = testing::smoothFrame({6, 3}, 1);
  frame.number = stream.state().next;
  frame.epoch = stream.state().epoch;
  Bytes bytes = encodeFrame(frame);
  const std::size_t size = bytes.size();
  const FrameHeader header = readFrameHeader(bytes, "");
  stream.add(header, std::move(bytes));
  return size;
}

TEST(Stream, KeepsItsNewestFrames) {
  Stream stream("s", {3, 1 << 20}, 100);
  EXPECT_EQ(stream.beginEpoch(description()), 100u);
  for (int i = 0; i < 5; ++i)
    add(stream);
  EXPECT_EQ(stream.state().oldest, 102u);
  EXPECT_EQ(stream.state().next, 105u);
  EXPECT_EQ(stream.frame(101), nullptr);
  EXPECT_EQ(stream.frame(105), nullptr);
  for (std::uint64_t number = 102; number < 105; ++number)
    EXPECT_EQ(stream.frame(number)->number(), number);
}

TEST(Stream, BoundsTheBytesOfItsHistory) {
  Stream stream("s", {100, 200}, 0);
  stream.beginEpoch(description());
  const std::size_t size = add(stream);
  for (int i = 0; i < 9; ++i)
    add(stream);
  EXPECT_EQ(stream.state().next - stream.state().oldest, 200 / size);
  // A frame that is larger than the history is kept alone.
  Stream small("s", {100, 1}, 0);
  small.beginEpoch(description());
  add(small);
  add(small);
  EXPECT_EQ(small.state().oldest, 1u);
}

TEST(Stream, RefusesFramesOutOfOrderAndOfOtherEpochs) {
  Stream stream("s", {}, 7);
  const Frame frame = testing::smoothFrame({6, 3}, 1);
  const auto refused = [&](std::uint64_t number, std::uint64_t epoch, FrameLayout layout) {
    FrameHeader header{layout, number, epoch, 0, Prediction::none, 0};
    EXPECT_THROW(stream.add(header, {}), Error);
  };
  refused(7, 7, {6, 3}); // before an epoch has begun
  stream.beginEpoch(description());
  refused(8, 7, {6, 3});
  refused(6, 6, {6, 3});
  refused(7, 6, {6, 3});
  refused(7, 7, {6, 2});
  add(stream);
  refused(7, 7, {6, 3});
  EXPECT_EQ(stream.beginEpoch(description()), 8u);
  refused(8, 7, {6, 3});
}

TEST(Stream, CallsOnceAtTheNextChange) {
  Stream stream("s", {}, 0);
  const auto owner = std::make_shared<int>();
  int calls = 0;
  const auto call = [&] { ++calls; };
  EXPECT_TRUE(stream.callAtChange(stream.state().version, owner, call));
  stream.beginEpoch(description());
  EXPECT_EQ(calls, 1);
  add(stream);
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(stream.callAtChange(stream.state().version - 1, owner, call));
  EXPECT_TRUE(stream.callAtChange(stream.state().version, std::make_shared<int>(), call));
  stream.end();
  EXPECT_EQ(calls, 1) << "the owner of the second call is gone";
}

TEST(Stream, ForgetsTheCallsOfViewersWhoHaveLeft) {
  Stream stream("s", {}, 0);
  const auto counter = std::make_shared<int>();
  for (int i = 0; i < 10'000; ++i)
    stream.callAtChange(0, std::make_shared<int>(), [counter] { ++*counter; });
  EXPECT_LT(counter.use_count(), 200);
}

TEST(Stream, DescribesItselfAsJson) {
  Stream stream("s", {}, 42);
  EXPECT_TRUE(nlohmann::json::parse(stream.latest(false)).at("number").is_null());
  Description full = description();
  full.layout.valueComponents = 2;
  full.layout.valueBits = 12;
  full.valueRange = {{0, 1}, {-1e-9, 1e30}};
  full.rate = 29.97;
  stream.beginEpoch(full);
  const auto json = nlohmann::json::parse(stream.latest(false));
  EXPECT_EQ(json.at("next"), 42);
  EXPECT_EQ(json.at("step").get<double>(), full.step());
  EXPECT_EQ(readDescription(stream.latest(false), ""), full) << "what it says describes the same stream";
}

TEST(Streams, AreLimitedAndNamedPlainly) {
  StreamLimits limits;
  limits.streams = 2;
  Streams streams(limits);
  EXPECT_EQ(streams.open("a"), streams.open("a"));
  streams.open("b");
  EXPECT_THROW(streams.open("c"), Error);
  EXPECT_THROW(streams.open("a/b"), Error);
  EXPECT_THROW(streams.open(""), Error);
  EXPECT_THROW(streams.open(std::string(65, 'a')), Error);
  EXPECT_EQ(streams.find("c"), nullptr);
}

TEST(Description, IsRefusedWithASentence) {
  for (const char* json :
       {"", "[]", "{}", "{\"vertices\": 6}", "{\"vertices\": -1, \"box\": [[0,0,0],[1,1,1]]}",
        "{\"vertices\": 6, \"box\": [[0,0],[1,1,1]]}", "{\"vertices\": 6, \"box\": [[0,0,0],[0,0,0]]}",
        "{\"vertices\": 6, \"box\": [[0,0,0],[1,1,1e999]]}",
        "{\"vertices\": 6, \"columns\": 4, \"box\": [[0,0,0],[1,1,1]]}",
        "{\"vertices\": 6, \"box\": [[0,0,0],[1,1,1]], \"rate\": 2000}",
        "{\"vertices\": 6, \"box\": [[0,0,0],[1,1,1]], \"valueComponents\": 1, \"valueBits\": 8}",
        "{\"vertices\": 6.5, \"box\": [[0,0,0],[1,1,1]]}"})
    try {
      readDescription(json, "test");
      ADD_FAILURE() << json;
    } catch (const Error& error) {
      EXPECT_EQ(error.location(), "test");
      EXPECT_NE(error.message(), "");
    }
}

} // namespace
} // namespace imgeo::live
