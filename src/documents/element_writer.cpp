#include "documents/element_writer.h"

#include "documents/xml_text.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t maxLineLength = 110;

} // namespace

void ElementWriter::indent() {
  if (isReadable())
    text_.append(2 * level_, ' ');
}

void ElementWriter::endLine() {
  if (isReadable() || openShapes_ == 0)
    text_ += "\n";
}

void ElementWriter::startTag(const Element& element) {
  std::size_t length = 2 * level_ + element.name.size() + 2;
  std::vector<std::string> lines;
  for (const auto& group : element.groups) {
    if (group.empty())
      continue;
    std::string line;
    for (const Attribute& attribute : group)
      line.append(line.empty() ? "" : " ").append(attribute.name).append("=").append(quoteAttribute(attribute.value));
    length += 1 + line.size();
    lines.push_back(std::move(line));
  }
  indent();
  text_ += "<" + element.name;
  std::string separator = " ";
  if (length > maxLineLength && isReadable())
    separator.assign("\n").append(2 * level_ + 4, ' ');
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_ += (i == 0 ? " " : separator) + lines[i];
  text_ += ">";
}

void ElementWriter::open(const Element& element) {
  const std::size_t begin = text_.size();
  startTag(element);
  openTags_.push_back({begin, text_.size()});
  openShapes_ += element.name == "Shape";
  endLine();
  ++level_;
}

/// Joins start tag, content and end tag if the content is one short line: in scenes of thousands of small shapes
/// indentation would be a third of the text.
void ElementWriter::close(const Element& element) {
  --level_;
  const auto [begin, end] = openTags_.back();
  openTags_.pop_back();
  openShapes_ -= element.name == "Shape";
  if (!isReadable()) {
    text_ += "</" + element.name + ">";
    return endLine();
  }
  const std::string endTag = "</" + element.name + ">\n";
  const std::size_t contentBegin = end + 1 + 2 * (level_ + 1), newline = text_.find('\n', end + 1);
  const bool isTagOnOneLine = text_.find('\n', begin) == end;
  const bool isContentOneLine = newline != std::string::npos && newline + 1 == text_.size();
  if (isTagOnOneLine && isContentOneLine && end - begin + newline - contentBegin + endTag.size() - 1 <= maxLineLength) {
    text_.erase(newline);
    text_.erase(end, contentBegin - end);
  } else {
    text_.append(2 * level_, ' ');
  }
  text_ += endTag;
}

void ElementWriter::leaf(const Element& element) {
  leaf(element, "");
}

void ElementWriter::leaf(const Element& element, std::string_view content) {
  startTag(element);
  if (layout_ == TextLayout::denseXml && content.empty())
    text_.insert(text_.size() - 1, "/");
  else
    text_ += escapeText(content) + "</" + element.name + ">";
  endLine();
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
  indent();
  text_ += "<!--" + kept + "-->";
  endLine();
}

std::string number(double value) {
  return fmt::format("{}", value);
}
std::string number(float value) {
  return fmt::format("{}", value);
}

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    text += text.empty() ? "" : " ";
    text += number(value);
  }
  return text;
}

} // namespace imgeo
