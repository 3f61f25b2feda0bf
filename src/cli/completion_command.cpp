// Completion scripts, made from the flag table.

#include "cli/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::cli {

namespace {

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const Command& command : commands())
    names.push_back(command.name);
  return names;
}

/// The short names of a flag and, if it has one, its long name.
std::vector<std::string> spellings(const Flag& flag) {
  std::vector<std::string> all = flag.aliases;
  if (flag.hasLongName())
    all.push_back("--" + flag.name);
  return all;
}

std::string bashScript() {
  std::string script = "_imgeo() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
                       "  COMPREPLY=()\n  if [[ $COMP_CWORD -eq 1 ]]; then\n"
                       "    COMPREPLY=($(compgen -W \"" +
                       fmt::format("{}", fmt::join(commandNames(), " ")) +
                       " --help --version\" -- \"$word\"))\n"
                       "    return\n  fi\n  case \"${COMP_WORDS[1]} $before\" in\n";
  for (const Command& command : commands())
    for (const Flag& flag : command.flags) {
      if (!flag.takesValue() || spellings(flag).empty())
        continue;
      std::vector<std::string> patterns;
      for (const std::string& name : spellings(flag))
        patterns.push_back(fmt::format("\"{} {}\"", command.name, name));
      const std::string action =
          flag.valueKind == ValueKind::choice
              ? fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))", fmt::join(flag.choices, " "))
          : flag.valueKind == ValueKind::directory ? "COMPREPLY=($(compgen -d -- \"$word\"))"
          : flag.valueKind == ValueKind::file      ? "COMPREPLY=($(compgen -f -- \"$word\"))"
                                                   : "COMPREPLY=()";
      script += fmt::format("    {}) {}; return ;;\n", fmt::join(patterns, "|"), action);
    }
  script += "  esac\n  case \"${COMP_WORDS[1]}\" in\n";
  for (const Command& command : commands()) {
    std::vector<std::string> names, words;
    for (const Flag& flag : command.flags) {
      if (flag.positional)
        words.insert(words.end(), flag.choices.begin(), flag.choices.end());
      if (flag.hasLongName())
        names.push_back("--" + flag.name);
    }
    script += fmt::format("    {}) if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); "
                          "else COMPREPLY=($(compgen {} -- \"$word\")); fi ;;\n",
                          command.name, fmt::join(names, " "),
                          words.empty() ? "-f" : fmt::format("-W \"{}\"", fmt::join(words, " ")));
  }
  return script + "  esac\n}\ncomplete -o filenames -F _imgeo imgeo\n";
}

/// Escapes text for a single-quoted argument of zsh's _arguments, where [ ] : have a meaning.
std::string zshText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':')
      escaped += '\\';
    escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return escaped;
}

std::string zshValue(const Flag& flag) {
  switch (flag.valueKind) {
  case ValueKind::none:
    return "";
  case ValueKind::choice:
    return fmt::format(":{}:({})", flag.name, fmt::join(flag.choices, " "));
  case ValueKind::file:
    return fmt::format(":{}:_files", flag.name);
  case ValueKind::directory:
    return fmt::format(":{}:_files -/", flag.name);
  case ValueKind::text:
  case ValueKind::integer:
    break;
  }
  return fmt::format(":{}: ", flag.name);
}

std::string zshScript() {
  std::string script = "#compdef imgeo\n\n_imgeo() {\n  local -a commands=(\n";
  for (const Command& command : commands())
    script += fmt::format("    '{}:{}'\n", command.name, zshText(command.summary));
  script += "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
            "  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const Command& command : commands()) {
    script += fmt::format("    {}) _arguments", command.name);
    for (const Flag& flag : command.flags)
      for (const std::string& name : spellings(flag))
        script += fmt::format(" \\\n      '{}[{}]{}'", name, zshText(flag.help), zshValue(flag));
    for (const Flag& flag : command.flags)
      if (flag.positional)
        script += fmt::format(" \\\n      '{}'", zshValue(flag));
    script += " ;;\n";
  }
  return script + "  esac\n}\n\n_imgeo \"$@\"\n";
}

std::string fishText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'' || c == '\\')
      escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string fishScript() {
  std::string script;
  for (const Command& command : commands())
    script += fmt::format("complete -c imgeo -n __fish_use_subcommand -f -a {} -d '{}'\n", command.name,
                          fishText(command.summary));
  for (const Command& command : commands()) {
    const std::string prefix = fmt::format("complete -c imgeo -n '__fish_seen_subcommand_from {}'", command.name);
    for (const Flag& flag : command.flags) {
      if (flag.positional && !flag.choices.empty())
        script += fmt::format("{} -f -a '{}'\n", prefix, fmt::join(flag.choices, " "));
      if (!flag.hasLongName())
        continue;
      script += fmt::format("{} -l {}", prefix, flag.name);
      for (const std::string& alias : flag.aliases)
        script += fmt::format(" -{} {}", alias.size() == 2 ? "s" : "o", alias.substr(1));
      if (flag.valueKind == ValueKind::choice)
        script += fmt::format(" -x -a '{}'", fmt::join(flag.choices, " "));
      if (flag.valueKind == ValueKind::text || flag.valueKind == ValueKind::integer)
        script += " -x";
      if (flag.valueKind == ValueKind::file)
        script += " -r -F";
      if (flag.valueKind == ValueKind::directory)
        script += " -x -a '(__fish_complete_directories)'";
      script += fmt::format(" -d '{}'\n", fishText(flag.help));
    }
  }
  return script;
}

} // namespace

int runCompletion(const Arguments& arguments) {
  const std::string& shell = arguments.text("shell");
  fmt::print("{}", shell == "bash" ? bashScript() : shell == "zsh" ? zshScript() : fishScript());
  return 0;
}

} // namespace imgeo::cli
