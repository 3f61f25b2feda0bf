#include "cli/shell_word.h"

#include <algorithm>
#include <string_view>

namespace imgeo::cli {

namespace {

bool isPlain(char c) {
  constexpr std::string_view marks = "_@%+=:,./-";
  const auto byte = static_cast<unsigned char>(c);
  const bool isLetter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || byte >= 0x80;
  return isLetter || (c >= '0' && c <= '9') || marks.find(c) != marks.npos;
}

} // namespace

std::string shellWord(const std::string& path) {
  std::string word = path.starts_with('-') ? "./" + path : path;
  if (!word.empty() && std::ranges::all_of(word, isPlain))
    return word;
  std::string quoted = "'";
  for (const char c : word)
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

} // namespace imgeo::cli
