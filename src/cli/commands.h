#pragma once
// The subcommands. Each prints its result on standard output and returns the exit code of the process. They throw
// errors; main reports them.

#include "cli/arguments.h"
#include "imgeo/ranks.h"

namespace imgeo::cli {

/// `launched`: which of the ranks that another program has started this process is, in the place of --rank and --ranks.
int runConvert(const Arguments& arguments, const RankOptions* launched = nullptr);
int runInfo(const Arguments& arguments);
int runVerify(const Arguments& arguments);
int runExport(const Arguments& arguments);
int runTransform(const Arguments& arguments);
int runSample(const Arguments& arguments);
/// `imgeo sample MOTION --live`
int runLiveSample(const Arguments& arguments);
/// `imgeo sample MOTION --frames N -o DIR`
int runFramesSample(const Arguments& arguments);
int runServe(const Arguments& arguments);
int runPublish(const Arguments& arguments);
int runCompletion(const Arguments& arguments);
int runManual(const Arguments& arguments);

} // namespace imgeo::cli
