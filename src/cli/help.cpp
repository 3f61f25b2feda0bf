#include "cli/help.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace imgeo::cli {

namespace {

constexpr std::size_t lineWidth = 80;

/// Wraps text into lines that are indented by `indent` columns; the first line is already indented.
std::string filled(const std::string& text, std::size_t indent) {
  std::string lines;
  std::istringstream words(text);
  std::size_t column = indent;
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > lineWidth) {
      lines += '\n';
      lines.append(indent, ' ');
      column = indent;
    } else if (column > indent) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

std::string valueOf(const Flag& flag) {
  return flag.valueKind == ValueKind::choice && !flag.positional ? fmt::format("{}", fmt::join(flag.choices, "|"))
                                                                 : flag.valueName;
}

/// "-vp, -qp, --position-bits N"
std::string namesOf(const Flag& flag) {
  std::string names = flag.positional ? flag.valueName : fmt::format("--{}", flag.name);
  if (flag.positional)
    return flag.aliases.empty() ? names
                                : fmt::format("{}, {} {}", names, fmt::join(flag.aliases, ", "), flag.valueName);
  if (!flag.aliases.empty())
    names = fmt::format("{}, {}", fmt::join(flag.aliases, ", "), names);
  return flag.takesValue() ? names + " " + valueOf(flag) : names;
}

std::string describe(const Flag& flag) {
  return flag.defaultValue.empty() ? flag.help : fmt::format("{} (default {})", flag.help, flag.defaultValue);
}

void addFlag(std::string& text, const Flag& flag) {
  constexpr std::size_t column = 30;
  const std::string names = "  " + namesOf(flag);
  text += names.size() + 2 > column ? names + "\n" + std::string(column, ' ') : fmt::format("{:{}}", names, column);
  text += filled(describe(flag), column) + "\n";
}

std::string exitCodeList() {
  std::string text = "\nExit codes:\n";
  for (const ExitCode& exit : exitCodes())
    text += fmt::format("  {}  {}\n", exit.code, filled(exit.meaning, 5));
  return text;
}

/// Escapes text for troff.
std::string troff(const std::string& text) {
  std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

} // namespace

std::string overview() {
  std::string text = "imgeo puts large 3D meshes on the web: the page shows the whole shape at once and\n"
                     "sharpens while it loads.\n\nUsage: imgeo COMMAND [arguments]\n\nCommands:\n";
  for (const Command& command : commands())
    text += fmt::format("  {:12}{}\n", command.name, command.summary);
  text += "\n  --help, -h  print this help; imgeo COMMAND --help prints a command's\n  --version   print the "
          "version\n";
  text += "\nExamples:\n";
  for (const char* name : {"convert", "info", "verify", "serve"})
    text += "  " + findCommand(name)->examples.front() + "\n";
  return text + exitCodeList();
}

std::string helpOf(const Command& command) {
  std::string text = fmt::format("imgeo {}: {}\n\nUsage: imgeo {}{}{}\n", command.name, command.summary, command.name,
                                 command.usage.empty() ? "" : " ", command.usage);
  if (!command.text.empty())
    text += fmt::format("\n{}\n", filled(command.text, 0));
  if (std::ranges::any_of(command.flags, &Flag::positional))
    text += "\nArguments:\n";
  for (const Flag& flag : command.flags)
    if (flag.positional)
      addFlag(text, flag);
  text += "\nOptions:\n";
  for (const Flag& flag : command.flags)
    if (!flag.positional)
      addFlag(text, flag);
  text += exitCodeList() + "\nExamples:\n";
  for (const std::string& example : command.examples)
    text += "  " + example + "\n";
  return text;
}

std::string manualPage(const std::string& version) {
  std::string text =
      fmt::format(".TH IMGEO 1 \"\" \"imgeo {}\"\n.SH NAME\nimgeo \\- large 3D meshes on the web, shown progressively\n"
                  ".SH SYNOPSIS\n",
                  version);
  for (const Command& command : commands())
    text += fmt::format(".B imgeo {}\n{}\n.br\n", command.name, troff(command.usage));
  text += ".SH COMMANDS\n";
  for (const Command& command : commands()) {
    text += fmt::format(".SS {}\n{}.\n", command.name, troff(command.summary));
    if (!command.text.empty())
      text += ".PP\n" + troff(command.text) + "\n";
    for (const Flag& flag : command.flags)
      text += fmt::format(".TP\n.B {}\n{}\n", troff(namesOf(flag)), troff(describe(flag)));
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCode& exit : exitCodes())
    text += fmt::format(".TP\n.B {}\n{}\n", exit.code, troff(exit.meaning));
  text += ".SH EXAMPLES\n.nf\n";
  for (const Command& command : commands())
    for (const std::string& example : command.examples)
      text += troff(example) + "\n";
  return text + ".fi\n";
}

} // namespace imgeo::cli
