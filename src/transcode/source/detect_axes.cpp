#include "transcode/source/detect_axes.h"

#include "transcode/source/guess_up.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

/// Points that the guess is made from. Feet of a thousandth of a surface get 20.
constexpr std::size_t guessSamples = 20'000;

void resolveUp(const Imported& imported, const SourceAxesOptions& options, const StoredMeshes* stored,
               SourceAxesReport& report) {
  if (options.up) {
    report.axes.up = *options.up;
    report.upReason = "stated";
  } else if (imported.up) {
    report.axes.up = *imported.up;
    report.upReason = fmt::format("as {} has it", imported.format);
  } else {
    UpGuess guess = guessUp(surfaceSamples(imported.scene, guessSamples, stored));
    report.axes.up = guess.up;
    report.upReason = std::move(guess.reason);
    report.isGuess = true;
  }
}

} // namespace

SourceAxesReport detectAxes(const Imported& imported, const SourceAxesOptions& options, const StoredMeshes* stored) {
  SourceAxesReport report;
  resolveUp(imported, options, stored, report);
  report.axes.rotations = options.rotations;
  report.axes.exaggeration = options.exaggeration;
  report.axes.scale = options.scale * options.metres.value_or(imported.metres.value_or(1));
  report.unitReason = options.metres    ? "stated"
                      : imported.metres ? fmt::format("as {} has it", imported.format)
                                        : "not stated";
  return report;
}

} // namespace imgeo
