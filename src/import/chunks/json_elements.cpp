#include "import/chunks/json_elements.h"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

namespace imgeo {

namespace {

constexpr std::string_view space = " \t\r\n";

/// The end of a string that begins at `at`, behind its quotation mark.
std::size_t endOfString(std::string_view text, std::size_t at) {
  for (++at; text[at] != '"'; ++at)
    at += text[at] == '\\';
  return at + 1;
}

/// The end of a value that begins at `at`.
std::size_t endOfValue(std::string_view text, std::size_t at) {
  if (text[at] == '"')
    return endOfString(text, at);
  if (text[at] != '[' && text[at] != '{') // a number, true, false or null
    return std::min(text.find_first_of(" \t\r\n,]}", at), text.size());
  std::size_t depth = 0;
  do {
    const char c = text[at];
    if (c == '"') {
      at = endOfString(text, at);
      continue;
    }
    depth += c == '[' || c == '{';
    depth -= c == ']' || c == '}';
    ++at;
  } while (depth > 0);
  return at;
}

/// The next character that is no white space, and neither a comma nor a colon.
std::size_t skipped(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t\r\n,:", at), text.size());
}

/// The value of a string that is written with quotation marks.
std::string unquoted(std::string_view text) {
  const std::string_view content = text.substr(1, text.size() - 2);
  return content.find('\\') == content.npos ? std::string(content) : nlohmann::json::parse(text).get<std::string>();
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(space), text.size()));
  return text.substr(0, text.find_last_not_of(space) + 1);
}

/// Calls visit(offset, length) for each element of an array or, of an object, each name and each value.
template <typename Visit> void forEachValue(std::string_view text, Visit visit) {
  for (std::size_t at = skipped(text, 1); at + 1 < text.size();) {
    const std::size_t end = endOfValue(text, at);
    visit(at, end - at);
    at = skipped(text, end);
  }
}

} // namespace

std::vector<JsonMember> membersOf(std::string_view text) {
  text = trimmed(text);
  std::vector<JsonMember> members;
  bool isName = true;
  if (text.starts_with('{'))
    forEachValue(text, [&](std::size_t offset, std::size_t length) {
      if (isName)
        members.push_back({unquoted(text.substr(offset, length)), {}});
      else
        members.back().value = text.substr(offset, length);
      isName = !isName;
    });
  return members;
}

std::vector<std::string_view> elementsOf(std::string_view text) {
  text = trimmed(text);
  std::vector<std::string_view> elements;
  if (text.starts_with('['))
    forEachValue(text,
                 [&](std::size_t offset, std::size_t length) { elements.push_back(text.substr(offset, length)); });
  return elements;
}

JsonElements::JsonElements(std::string_view array) : array_(trimmed(array)) {
  assert(array_.size() <= UINT32_MAX);
  if (array_.starts_with('['))
    forEachValue(array_, [&](std::size_t offset, std::size_t length) {
      ranges_.push_back({static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(length)});
    });
  ranges_.shrink_to_fit();
}

} // namespace imgeo
