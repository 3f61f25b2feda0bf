#include "documents/element.h"

#include "documents/text.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t lineLength = 110;

} // namespace

void ElementWriter::startTag(const Element& element) {
  std::size_t length = 2 * level_ + element.name.size() + 2;
  std::vector<std::string> lines;
  for (const auto& group : element.groups) {
    if (group.empty())
      continue;
    std::string line;
    for (const Attribute& attribute : group)
      line.append(line.empty() ? "" : " ")
          .append(attribute.name)
          .append("=")
          .append(quoteAttribute(attribute.value));
    length += 1 + line.size();
    lines.push_back(std::move(line));
  }
  text_.append(2 * level_, ' ');
  text_ += "<" + element.name;
  const std::string separator = length <= lineLength ? " " : "\n" + std::string(2 * level_ + 4, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_ += (i == 0 ? " " : separator) + lines[i];
  text_ += ">";
}

void ElementWriter::open(const Element& element) {
  startTag(element);
  text_ += "\n";
  ++level_;
}

void ElementWriter::close(const Element& element) {
  --level_;
  text_.append(2 * level_, ' ');
  text_ += "</" + element.name + ">\n";
}

void ElementWriter::leaf(const Element& element) {
  leaf(element, "");
}

void ElementWriter::leaf(const Element& element, std::string_view content) {
  startTag(element);
  text_ += escapeText(content) + "</" + element.name + ">\n";
}

void ElementWriter::comment(std::string_view content) {
  std::string kept;
  for (const char c : validText(content)) {
    if (c == '-' && kept.ends_with('-'))
      kept += ' ';
    kept += c;
  }
  if (kept.ends_with('-'))
    kept += ' ';
  text_.append(2 * level_, ' ');
  text_ += "<!--" + kept + "-->\n";
}

std::string number(double value) {
  return fmt::format("{}", value);
}
std::string number(float value) {
  return fmt::format("{}", value);
}

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : " ") + number(value);
  return text;
}

std::string strings(const std::vector<std::string>& values) {
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
