#pragma once
// Frames of a generated motion on the lattice of its box, for benchmarks of recorded sequences.

#include "live/quantise.h"
#include "motions/motion.h"

namespace imgeo {

/// Frames of a second.
inline constexpr std::uint32_t perFile = 30;
inline constexpr double interval = 1.0 / perFile;

inline live::Description describe(const Motion& motion) {
  live::Description description;
  description.layout.vertices = static_cast<std::uint32_t>(motion.positions().size());
  description.layout.columns = motion.columns();
  description.box = motion.box();
  description.rate = perFile;
  return description;
}

inline std::vector<live::Frame> framesOf(Motion& motion, const live::Description& description) {
  for (std::uint32_t warmUp = 0; warmUp < perFile; ++warmUp)
    motion.advance(interval);
  std::vector<live::Frame> frames(perFile);
  for (std::uint32_t i = 0; i < perFile; ++i) {
    motion.advance(interval);
    live::quantise({{&motion.positions().front().x, 3 * motion.positions().size()}, {}, {}, {}}, description,
                   frames[i]);
    frames[i].number = i;
    frames[i].time = i * interval;
  }
  return frames;
}

} // namespace imgeo
