#pragma once
// The table of commands and flags: the source of the parser, the help texts, the shell completions and the manual page.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo::cli {

/// Kind of a flag's value. Checks and completions depend on it.
enum class ValueKind : std::uint8_t { none, text, file, directory, integer, choice };

struct Flag {
  std::string name;                   ///< "position-bits"; for positional arguments "input"
  std::vector<std::string> aliases{}; ///< short names: "-vp", "-qp"
  ValueKind valueKind = ValueKind::none;
  std::string valueName{};            ///< "N", "DIR"
  std::string help{};                 ///< begins in lower case, no full stop
  std::string defaultValue{};         ///< value when the flag is not given; empty: none
  std::vector<std::string> choices{}; ///< ValueKind::choice
  std::int64_t min = 0, max = 0;      ///< ValueKind::integer
  bool positional = false;            ///< may be given without its name
  bool repeatable = false;            ///< any number of values may be given
  bool required = false;

  bool takesValue() const { return valueKind != ValueKind::none; }

  /// Whether --NAME is a spelling of the flag: a positional argument has one if it has a short name, too.
  bool hasLongName() const { return !positional || !aliases.empty(); }
};

struct Command {
  std::string name;
  std::string usage;   ///< what follows "imgeo NAME"
  std::string summary; ///< one line for the list of commands
  std::string text;    ///< one paragraph that describes the command
  std::vector<Flag> flags;
  std::vector<std::string> examples;
};

/// Every command. The last flag of each is --help.
std::span<const Command> commands();

/// The command of this name; nullptr if there is none.
const Command* findCommand(const std::string& name);

/// Exit codes and what they mean, for help and manual.
struct ExitCode {
  int code;
  std::string meaning;
};
std::span<const ExitCode> exitCodes();

} // namespace imgeo::cli
