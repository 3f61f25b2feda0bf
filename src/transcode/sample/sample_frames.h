#pragma once
// Writes the frames of a generated motion to mesh files.

#include "motions/motion.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace imgeo {

struct FramesReport {
  std::uint64_t bytes = 0; ///< of all files
};

/// Writes `count` frames, `rate` of which are a second, as NAME-0001.ply ... into a folder, which is made and must not
/// hold anything: triangles where the motion is a grid, points otherwise, y up. Calls done() after each frame. Throws
/// Error{io, usage}.
FramesReport writeSampleFrames(Motion& motion, const std::string& name, std::uint32_t count, double rate,
                               const std::filesystem::path& folder, const std::function<void()>& done);

} // namespace imgeo
