#pragma once
// Parses the arguments of a command line into the values of the flags.

#include "cli/flags.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace imgeo::cli {

/// A command and the values of its flags: given ones and defaults.
struct Arguments {
  const Command* command = nullptr; ///< nullptr: `imgeo` alone with --help or --version
  std::map<std::string, std::string> values;
  std::map<std::string, bool> switches;
  std::map<std::string, std::vector<std::string>> lists{}; ///< of repeatable flags

  const std::string& text(const std::string& name) const { return values.at(name); }
  std::int64_t integer(const std::string& name) const { return std::stoll(values.at(name)); }
  const std::vector<std::string>& list(const std::string& name) const { return lists.at(name); }
  bool has(const std::string& name) const { return switches.at(name); }
};

/// Replaces the short names of a command's flags by their long ones: "-vp 14" becomes "--position-bits 14"; "-vp14" and
/// "-vp=14" become "--position-bits=14"; "-oDIR" becomes "--output=DIR". Words after "--" stay as they are.
std::vector<std::string> expandAliases(const Command& command, std::vector<std::string> words);

/// Parses `words`, the command line without the program's name. Throws Error{usage}.
Arguments parseArguments(std::vector<std::string> words);

} // namespace imgeo::cli
