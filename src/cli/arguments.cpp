#include "cli/arguments.h"

#include "base/error.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace imgeo::cli {

namespace {

[[noreturn]] void refuse(const Command* command, const std::string& message) {
  throw Error(ErrorKind::usage, "", fmt::format("{}; see imgeo {}--help", message, command ? command->name + " " : ""));
}

/// What is wrong with a value; empty if it is valid.
std::string faultOf(const Flag& flag, const std::string& value) {
  if (flag.valueKind == ValueKind::choice && std::ranges::find(flag.choices, value) == flag.choices.end())
    return fmt::format("\"{}\" is not {}", value, fmt::join(flag.choices, " or "));
  if (flag.valueKind == ValueKind::integer) {
    std::int64_t number = 0;
    const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (fault != std::errc{} || end != value.data() + value.size())
      return fmt::format("\"{}\" is not a whole number", value);
    if (number < flag.min || number > flag.max)
      return flag.min == flag.max ? fmt::format("{} cannot be honoured, only {}", number, flag.min)
                                  : fmt::format("{} is not within {}..{}", number, flag.min, flag.max);
  }
  if (value.empty())
    return "is empty";
  return "";
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] != b[j])}));
  }
  return row[b.size()];
}

/// ", did you mean NAME?" for the most similar of `names`; empty if none is similar.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const auto nearest =
      std::ranges::min_element(names, {}, [&](const std::string& name) { return editDistance(word, name); });
  if (nearest == names.end() || editDistance(word, *nearest) > 1 + nearest->size() / 4)
    return "";
  return fmt::format(", did you mean {}?", *nearest);
}

std::string messageOf(const CLI::ParseError& error, const CLI::App& app, const Command& command) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const std::string word = app.remaining().empty() ? "" : app.remaining().front();
    std::vector<std::string> names;
    for (const Flag& flag : command.flags)
      names.push_back("--" + flag.name);
    if (word.starts_with("-"))
      return fmt::format("there is no option {}{}", word.substr(0, word.find('=')), suggestion(word, names));
    return fmt::format("one argument too many: \"{}\"", word);
  }
  std::string message = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    const bool tooMany = message.find("At Most") != message.npos;
    return message.substr(0, message.find(':')) + (tooMany ? " is given more than once" : " lacks its value");
  }
  return message;
}

Arguments parseCommand(const Command& command, std::vector<std::string> words) {
  Arguments arguments{&command, {}, {}};
  words = expandAliases(command, std::move(words));
  CLI::App app;
  app.set_help_flag();
  for (const Flag& flag : command.flags) {
    if (!flag.takesValue()) {
      app.add_flag("--" + flag.name, arguments.switches[flag.name]);
      continue;
    }
    const std::string names = (flag.positional ? flag.name : "") + (flag.positional && flag.hasLongName() ? "," : "") +
                              (flag.hasLongName() ? "--" + flag.name : "");
    const auto check = [&flag](const std::string& value) { return faultOf(flag, value); };
    if (flag.repeatable) {
      app.add_option(names, arguments.lists[flag.name])->check(check);
      continue;
    }
    arguments.values[flag.name] = flag.defaultValue;
    app.add_option(names, arguments.values[flag.name])->check(check);
  }
  std::ranges::reverse(words); // CLI11 reads them in reverse order
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (arguments.has("help"))
      return arguments;
    refuse(&command, messageOf(error, app, command));
  }
  if (arguments.has("help"))
    return arguments;
  for (const Flag& flag : command.flags)
    if (flag.required && (flag.repeatable ? arguments.lists[flag.name].empty() : arguments.values[flag.name].empty()))
      refuse(&command, fmt::format("{} is missing: imgeo {} {}",
                                   flag.positional ? flag.valueName : fmt::format("--{} {}", flag.name, flag.valueName),
                                   command.name, command.usage));
  return arguments;
}

/// The word with the flag's long name; nothing if it does not begin with a short name of the flag.
std::optional<std::vector<std::string>> expand(const Flag& flag, const std::string& word) {
  for (const std::string& alias : flag.aliases) {
    if (!word.starts_with(alias))
      continue;
    const std::string rest = word.substr(alias.size());
    if (rest.empty())
      return std::vector{"--" + flag.name};
    if (!flag.takesValue())
      continue;
    if (rest.starts_with("="))
      return std::vector{"--" + flag.name + rest};
    const bool isNumber = std::ranges::all_of(rest, [](char c) { return c >= '0' && c <= '9'; });
    if (flag.valueKind == ValueKind::integer ? isNumber : alias.size() == 2)
      return std::vector{"--" + flag.name + "=" + rest};
  }
  return std::nullopt;
}

} // namespace

std::vector<std::string> expandAliases(const Command& command, std::vector<std::string> words) {
  std::vector<std::string> expanded;
  bool literal = false;
  for (std::string& word : words) {
    literal |= word == "--";
    const bool isShort = !literal && word.size() >= 2 && word[0] == '-' && word[1] != '-';
    std::optional<std::vector<std::string>> replacement;
    for (const Flag& flag : command.flags)
      if (isShort && !replacement)
        replacement = expand(flag, word);
    if (replacement)
      expanded.insert(expanded.end(), replacement->begin(), replacement->end());
    else
      expanded.push_back(std::move(word));
  }
  return expanded;
}

Arguments parseArguments(std::vector<std::string> words) {
  if (words.empty())
    refuse(nullptr, "no command is given");
  const std::string first = words.front();
  words.erase(words.begin());
  if (first == "--help" || first == "-h" || (first == "help" && words.empty()))
    return {nullptr, {}, {{"help", true}, {"version", false}}};
  if (first == "--version")
    return {nullptr, {}, {{"help", false}, {"version", true}}};
  if (first == "help")
    return parseArguments({words.front(), "--help"});
  const Command* command = findCommand(first);
  if (!command) {
    std::vector<std::string> names;
    for (const Command& known : commands())
      names.push_back(known.name);
    refuse(nullptr, fmt::format("there is no command \"{}\"{}", first, suggestion(first, names)));
  }
  return parseCommand(*command, std::move(words));
}

} // namespace imgeo::cli
