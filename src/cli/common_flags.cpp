#include "cli/common_flags.h"

namespace imgeo::cli {

Flag helpFlag() {
  return {.name = "help", .aliases = {"-h"}, .help = "print this help"};
}
Flag jsonFlag(const std::string& what) {
  return {.name = "json", .help = "print " + what + " as JSON"};
}

Flag outsideFlag() {
  return {.name = "outside", .help = "let the source refer to files outside of its folder"};
}

Flag positionalFlag(const std::string& name, const std::string& valueName, ValueKind valueKind,
                    const std::string& help) {
  return {
      .name = name, .valueKind = valueKind, .valueName = valueName, .help = help, .positional = true, .required = true};
}

Flag choiceFlag(const std::string& name, std::vector<std::string> choices, const std::string& help) {
  return {
      .name = name, .valueKind = ValueKind::choice, .help = help, .defaultValue = choices.front(), .choices = choices};
}

Flag integerFlag(const std::string& name, std::vector<std::string> aliases, std::int64_t min, std::int64_t max,
                 const std::string& defaultValue, const std::string& help) {
  return {.name = name,
          .aliases = std::move(aliases),
          .valueKind = ValueKind::integer,
          .valueName = "N",
          .help = help,
          .defaultValue = defaultValue,
          .min = min,
          .max = max};
}

Flag textFlag(const std::string& name, const std::string& valueName, const std::string& help) {
  return {.name = name, .valueKind = ValueKind::text, .valueName = valueName, .help = help};
}

} // namespace imgeo::cli
