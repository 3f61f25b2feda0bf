// `imgeo sample MOTION --frames N -o DIR`: the frames of a motion, to be converted to a sequence.
#include "base/error.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "motions/motion.h"
#include "transcode/sample/sample_frames.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

int runFramesSample(const Arguments& arguments) {
  const std::string& name = arguments.text("sample");
  const auto count = static_cast<std::uint32_t>(arguments.integer("frames"));
  const std::string& folder = arguments.text("output");
  if (count == 0 || folder.empty())
    throw Error(ErrorKind::usage, "",
                fmt::format("{} is a motion: imgeo sample {} --live, or --frames N -o DIR", name, name));
  const auto motion = makeMotion(name, static_cast<std::uint32_t>(arguments.integer("grid")),
                                 static_cast<std::uint32_t>(arguments.integer("seed")));
  const FramesReport written = writeSampleFrames(*motion, name, count, static_cast<double>(arguments.integer("rate")),
                                                 folder, throwIfInterrupted);
  if (arguments.has("json"))
    fmt::print("{}\n", nlohmann::ordered_json{{"frames", count}, {"bytes", written.bytes}}.dump(2));
  else
    fmt::print("{}: {} frames of {} vertices, {}\n", folder, grouped(count), grouped(motion->positions().size()),
               byteSize(written.bytes));
  return 0;
}

} // namespace imgeo::cli
