#pragma once
// A path as a word of a command line, for commands that are printed to be copied.

#include <string>

namespace imgeo::cli {

/// `path` in single quotes where a shell would read it otherwise; behind "./" where the tool would take it for a flag.
std::string shellWord(const std::string& path);

} // namespace imgeo::cli
