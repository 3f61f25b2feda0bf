#pragma once
// Flags that several commands have, and functions that make a flag by the kind of its value.

#include "cli/flags.h"

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::cli {

/// --help, the last flag of every command.
Flag helpFlag();

/// --json, which prints `what`.
Flag jsonFlag(const std::string& what);

/// --outside, of commands that read sources.
Flag outsideFlag();

/// A required argument that may be given without its name.
Flag positionalFlag(const std::string& name, const std::string& valueName, ValueKind valueKind,
                    const std::string& help);

/// A flag that chooses from a list; the first of `choices` is its default.
Flag choiceFlag(const std::string& name, std::vector<std::string> choices, const std::string& help);

/// A flag whose value is an integer from `min` to `max`. Without a `defaultValue` the command chooses one.
Flag integerFlag(const std::string& name, std::vector<std::string> aliases, std::int64_t min, std::int64_t max,
                 const std::string& defaultValue, const std::string& help);

Flag textFlag(const std::string& name, const std::string& valueName, const std::string& help);

} // namespace imgeo::cli
