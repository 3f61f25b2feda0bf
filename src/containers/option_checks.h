#pragma once
// Checks of options that all encodings share. Errors name the option as on the command line.

#include "base/error.h"
#include "containers/encodings.h"
#include "imgeo/convert.h"

#include <cstdint>
#include <string>

namespace imgeo {

[[noreturn]] inline void refuseOption(const char* option, const std::string& why) {
  throw Error(ErrorKind::usage, option, why);
}

inline void requireWithin(const char* option, std::int64_t value, std::int64_t min, std::int64_t max) {
  if (value < min || value > max)
    refuseOption(option, std::to_string(value) + " is not within " + std::to_string(min) + ".." + std::to_string(max));
}

/// For encodings whose files are images.
inline void requireNoElementTypes(const ConvertOptions& options) {
  if (options.coordType)
    refuseOption("--coord-type", "images hold bytes; element types belong to bg");
  if (options.layout != Layout::separate)
    refuseOption("--layout", "images are not interleaved; that belongs to bg");
}

} // namespace imgeo
