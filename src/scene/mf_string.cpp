#include "scene/mf_string.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::string_view separators = " \t\r\n,";

} // namespace

std::vector<std::string> parseStrings(std::string_view text) {
  std::vector<std::string> strings;
  const std::size_t first = text.find_first_not_of(separators);
  if (first == text.npos)
    return strings;
  if (text[first] != '"')
    return {std::string(text.substr(first, text.find_last_not_of(separators) + 1 - first))};
  for (std::size_t at = first; at < text.size() && text[at] == '"';
       at = std::min(text.find_first_not_of(separators, at), text.size())) {
    std::string value;
    for (++at; at < text.size() && text[at] != '"'; ++at) {
      at += text[at] == '\\' && at + 1 < text.size();
      value += text[at];
    }
    ++at;
    strings.push_back(std::move(value));
  }
  return strings;
}

std::string quoteStrings(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) {
    text += text.empty() ? "\"" : " \"";
    for (const char c : value) {
      if (c == '"' || c == '\\')
        text += '\\';
      text += c;
    }
    text += '"';
  }
  return text;
}

} // namespace imgeo
