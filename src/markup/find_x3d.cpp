#include "markup/find_x3d.h"

#include "base/error.h"

#include <algorithm>

namespace imgeo {

namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

class Scanner {
public:
  Scanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  TextSpan find() {
    std::size_t begin = std::string_view::npos;
    for (std::size_t at = text_.find('<'); at != std::string_view::npos; at = text_.find('<', at)) {
      const std::string_view rest = text_.substr(at);
      if (const std::size_t end = endOfDeclaration(at, rest); end != at) {
        at = end;
        continue;
      }
      const std::size_t end = endOfTag(at);
      const std::string_view tag = tagName(rest);
      if (begin == std::string_view::npos && equalIgnoringCase(tag, "x3d")) {
        begin = at;
        if (text_[end - 2] == '/')
          return {begin, end};
      } else if (begin != std::string_view::npos && equalIgnoringCase(tag, "/x3d")) {
        return {begin, end};
      }
      at = begin == std::string_view::npos ? endOfRawText(tag, end) : end;
    }
    if (begin == std::string_view::npos)
      throw Error(ErrorKind::malformed, name_, "there is no <X3D> element");
    throw Error(ErrorKind::malformed, locationOf(text_, name_, begin), "the <X3D> element has no end");
  }

private:
  [[noreturn]] void fail(ErrorKind kind, std::size_t at, const char* message) const {
    throw Error(kind, locationOf(text_, name_, at), message);
  }

  /// The offset after the next `terminator` from `at`. Without one, throws Error{malformed} with `message`.
  std::size_t endAfter(std::string_view terminator, std::size_t at, const char* message) const {
    const std::size_t found = text_.find(terminator, at);
    if (found == std::string_view::npos)
      fail(ErrorKind::malformed, at, message);
    return found + terminator.size();
  }

  /// The offset after a comment, CDATA section, instruction or document type; `at` for a tag.
  std::size_t endOfDeclaration(std::size_t at, std::string_view rest) const {
    if (rest.starts_with("<!--"))
      return endAfter("-->", at + 4, "a comment has no end");
    if (rest.starts_with("<![CDATA["))
      return endAfter("]]>", at, "a CDATA section has no end");
    if (rest.starts_with("<?"))
      return endAfter(">", at, "an instruction has no end");
    if (!rest.starts_with("<!"))
      return at;
    const std::size_t end = endAfter(">", at, "a declaration has no end");
    std::string_view type = rest.substr(2, end - at - 3);
    if (!beginsIgnoringCase(type, "doctype"))
      fail(ErrorKind::malformed, at, "a declaration of unknown kind");
    type.remove_prefix(7);
    while (!type.empty() && isSpace(type.front()))
      type.remove_prefix(1);
    while (!type.empty() && isSpace(type.back()))
      type.remove_suffix(1);
    if (!equalIgnoringCase(type, "html"))
      fail(ErrorKind::unsupported, at, "document types other than html are not read");
    return end;
  }

  std::size_t endOfTag(std::size_t at) const {
    char quote = 0;
    for (std::size_t i = at + 1; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != 0)
        quote = c == quote ? char{0} : quote;
      else if (c == '"' || c == '\'')
        quote = c;
      else if (c == '>')
        return i + 1;
    }
    fail(ErrorKind::malformed, at, "a tag has no end");
  }

  /// The name after '<', including the slash of an end tag.
  static std::string_view tagName(std::string_view tag) {
    std::size_t end = 1;
    if (end < tag.size() && tag[end] == '/')
      ++end;
    while (end < tag.size() && !isSpace(tag[end]) && tag[end] != '>' && tag[end] != '/')
      ++end;
    return tag.substr(1, end - 1);
  }

  /// The end of the content of an HTML raw text element, in which there are no tags; `at` for other elements.
  std::size_t endOfRawText(std::string_view tag, std::size_t at) const {
    for (const std::string_view raw : {"script", "style", "title", "textarea"}) {
      if (!equalIgnoringCase(tag, raw))
        continue;
      const std::string end = "</" + std::string(raw);
      for (std::size_t i = text_.find("</", at); i != std::string_view::npos; i = text_.find("</", i + 2))
        if (beginsIgnoringCase(text_.substr(i), end))
          return i;
      fail(ErrorKind::malformed, at, "a script, style or title has no end");
    }
    return at;
  }

  std::string_view text_;
  const std::string& name_;
};

} // namespace

TextSpan findX3d(std::string_view text, const std::string& name) {
  return Scanner(text, name).find();
}

std::string locationOf(std::string_view text, const std::string& name, std::size_t at) {
  const auto line = 1 + std::ranges::count(text.substr(0, at), '\n');
  return name + ":" + std::to_string(line);
}

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

bool beginsIgnoringCase(std::string_view text, std::string_view prefix) {
  return equalIgnoringCase(text.substr(0, prefix.size()), prefix);
}

} // namespace imgeo
