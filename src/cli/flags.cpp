#include "cli/flags.h"

#include "cli/common_flags.h"
#include "cli/convert_flags.h"
#include "cli/live_flags.h"
#include "cli/site_flags.h"

#include <algorithm>

namespace imgeo::cli {

namespace {

Command completionCommand() {
  Flag shell = positionalFlag("shell", "SHELL", ValueKind::choice, "bash, zsh or fish");
  shell.choices = {"bash", "zsh", "fish"};
  return {.name = "completion",
          .usage = "SHELL",
          .summary = "print a completion script for bash, zsh or fish",
          .text = "",
          .flags = {shell, helpFlag()},
          .examples = {"imgeo completion bash > ~/.local/share/bash-completion/completions/imgeo",
                       "imgeo completion zsh > ~/.zfunc/_imgeo",
                       "imgeo completion fish > ~/.config/fish/completions/imgeo.fish"}};
}

Command manualCommand() {
  return {.name = "manual",
          .usage = "",
          .summary = "print the manual page",
          .text = "",
          .flags = {helpFlag()},
          .examples = {"imgeo manual > imgeo.1 && man ./imgeo.1"}};
}

} // namespace

std::span<const Command> commands() {
  static const std::vector<Command> all{convertCommand(),    infoCommand(),   verifyCommand(), exportCommand(),
                                        transformCommand(),  sampleCommand(), serveCommand(),  publishCommand(),
                                        completionCommand(), manualCommand()};
  return all;
}

const Command* findCommand(const std::string& name) {
  const auto found = std::ranges::find(commands(), name, &Command::name);
  return found == commands().end() ? nullptr : &*found;
}

std::span<const ExitCode> exitCodes() {
  static const std::vector<ExitCode> all{
      {0, "done; for verify: equal"},
      {1, "wrong usage: an option that cannot be honoured, a directory that is not ours"},
      {2, "a file could not be read or written, an address not be had"},
      {3, "bad input: truncated, malformed, unsupported or too large; for verify: not equal"},
      {4, "an internal fault"}};
  return all;
}

} // namespace imgeo::cli
