#pragma once
// For tests: sequences of every kind.

#include "live/frame_samples.h"
#include "sequence/sequence_file.h"

namespace imgeo::testing {

/// A sequence, its frames, and the bytes of its only file.
struct SequenceSample {
  std::string name;
  SequenceIndex index;
  std::vector<live::Frame> frames;
  Bytes bytes;
};

/// Frames whose integers drift: frame n is the first one with `drift` * n added, and a little noise.
inline SequenceSample sequenceSample(const std::string& name, const live::FrameLayout& layout, std::uint32_t count,
                                     std::uint32_t drift) {
  SequenceSample sample{name, {}, {}, {}};
  live::testing::Random random(layout.vertices + count);
  live::Frame frame = live::testing::smoothFrame(layout, layout.vertices);
  frame.epoch = 0;
  for (std::uint32_t n = 0; n < count; ++n) {
    frame.number = n;
    frame.time = n / 25.0;
    sample.frames.push_back(frame);
    for (const live::ComponentBits& attribute : live::attributesOf(layout))
      for (std::size_t i = std::size_t{attribute.first} * layout.vertices;
           i < std::size_t{attribute.first + attribute.count} * layout.vertices; ++i)
        frame.components[i] = (frame.components[i] + drift + random() % 3) & ((1u << attribute.bits) - 1);
  }
  live::Description& description = sample.index.description;
  description.layout = layout;
  description.rate = 25;
  description.box = {{-1, -2, -3}, {3, 2, 1}};
  description.valueRange.assign(layout.valueComponents, {0, 1});
  if (layout.valueComponents > 0)
    sample.index.valueName = "speed \"0\"";
  sample.bytes = encodeSequenceFile(sample.frames, 6);
  sample.index.files = {{name + ".igf", count, sample.bytes.size()}};
  return sample;
}

/// The sequences of vectors/sequence-1.
inline std::vector<SequenceSample> sequenceSamples() {
  return {
      sequenceSample("one-frame", {12, 4}, 1, 0),
      sequenceSample("grid", {35, 7}, 4, 100),
      sequenceSample("points", {40, 0}, 5, 7),
      sequenceSample("bits-11", {35, 7, 11}, 3, 60),
      sequenceSample("bits-24", {35, 0, 24}, 3, 1 << 20),
      sequenceSample("all-attributes", {36, 6, 20, 13, 4, 4, 24}, 3, 9),
  };
}

} // namespace imgeo::testing
