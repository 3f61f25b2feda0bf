// Reads the <x3d> element of HTML pages with gumbo.
//
// gumbo has one tag for all elements that HTML does not define, so that any end tag of such an element closes the
// innermost of them: in <Shape><Appearance><Material></Appearance> it closes the Material. Browsers compare names. So
// gumbo gives the tokens of the <x3d> element (it knows what is a comment, a script, an attribute or a character
// reference), and PageBuilder nests them, by HTML5's rule for elements without rules of their own.

#include "base/error.h"
#include "markup/find_x3d.h"
#include "markup/gumbo_memory.h"
#include "markup/x3d_element.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <gumbo.h>
#include <set>

namespace imgeo {

namespace {

constexpr std::string_view x3dName = "x3d";

/// A start tag, an end tag or a comment.
struct Token {
  enum class Kind { start, end, comment };

  std::size_t offset = 0;
  Kind kind = Kind::start;
  std::string_view name{};         ///< of a tag, as the text has it
  const GumboNode* node = nullptr; ///< absent for the end tags that gumbo ignores
};

std::string_view textOf(GumboStringPiece piece) {
  return {piece.data, piece.length};
}

/// The name in the text of a tag.
std::string_view tagNameOf(GumboStringPiece tag) {
  gumbo_tag_from_original_text(&tag);
  return textOf(tag);
}

bool isNameCharacter(char c, bool isFirst) {
  const bool isLetter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || (c & 0x80) != 0;
  return isLetter || (!isFirst && ((c >= '0' && c <= '9') || c == '-' || c == '.' || c == ':'));
}

bool isXmlName(std::string_view name) {
  return !name.empty() && isNameCharacter(name[0], true) &&
         std::ranges::all_of(name, [](char c) { return isNameCharacter(c, false); });
}

/// Elements that have no content, of which X3D has some too (meta, param).
bool isVoid(std::string_view name) {
  constexpr std::array names{"area",  "base", "br",   "col",   "embed",  "hr",    "img",
                             "input", "link", "meta", "param", "source", "track", "wbr"};
  return std::ranges::any_of(names, [&](const char* each) { return equalIgnoringCase(name, each); });
}

bool isKnownToGumbo(const GumboNode& node) {
  return node.v.element.tag != GUMBO_TAG_UNKNOWN;
}

/// Collects the tokens of a tree from an offset on, in the order of the text.
class Tokens {
public:
  Tokens(std::string_view html, const GumboNode& root, const GumboNode& x3d)
      : html_(html), begin_(offsetOf(x3d.v.element.original_tag)) {
    std::vector<const GumboNode*> waiting{&root};
    while (!waiting.empty()) {
      const GumboNode& node = *waiting.back();
      waiting.pop_back();
      add(node);
      if (const GumboVector* children = childrenOf(node))
        for (unsigned i = 0; i < children->length; ++i)
          waiting.push_back(static_cast<const GumboNode*>(children->data[i]));
    }
    std::ranges::stable_sort(tokens_, {}, &Token::offset);
    addIgnoredEndTags();
  }

  const std::vector<Token>& inOrder() const { return tokens_; }

  static const GumboVector* childrenOf(const GumboNode& node) {
    if (node.type == GUMBO_NODE_DOCUMENT)
      return &node.v.document.children;
    return node.type == GUMBO_NODE_ELEMENT ? &node.v.element.children : nullptr;
  }

private:
  void add(const GumboNode& node) {
    if (node.type == GUMBO_NODE_COMMENT && offsetOf(node.v.text.original_text) > begin_)
      tokens_.push_back({offsetOf(node.v.text.original_text), Token::Kind::comment, {}, &node});
    if (node.type != GUMBO_NODE_ELEMENT)
      return;
    const GumboElement& element = node.v.element;
    if (element.original_tag.length > 0 && offsetOf(element.original_tag) >= begin_)
      tokens_.push_back({offsetOf(element.original_tag), Token::Kind::start, tagNameOf(element.original_tag), &node});
    if (element.original_end_tag.length > 0 && offsetOf(element.original_end_tag) > begin_)
      tokens_.push_back(
          {offsetOf(element.original_end_tag), Token::Kind::end, tagNameOf(element.original_end_tag), &node});
  }

  std::size_t offsetOf(GumboStringPiece piece) const { return static_cast<std::size_t>(piece.data - html_.data()); }

  /// Adds the end tags that gumbo ignores since it has closed their elements before: all those between two tokens.
  void addIgnoredEndTags() {
    std::vector<Token> all;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      all.push_back(tokens_[i]);
      const std::size_t next = i + 1 < tokens_.size() ? tokens_[i + 1].offset : html_.size();
      if (hasRawText(tokens_[i]))
        continue;
      const std::string_view before = html_.substr(0, next);
      for (std::size_t at = before.find("</", endOf(tokens_[i])); at < next; at = before.find("</", at + 2))
        if (const std::string_view name = nameAt(at + 2); !name.empty())
          all.push_back({at, Token::Kind::end, name, nullptr});
    }
    tokens_ = std::move(all);
  }

  /// Whether markup after a token up to the next one is text: a script's, or what the page's head may hold.
  static bool hasRawText(const Token& token) {
    constexpr std::array names{"script", "style",   "title",    "textarea", "xmp",
                               "iframe", "noembed", "noframes", "plaintext"};
    return token.kind == Token::Kind::start &&
           std::ranges::any_of(names, [&](const char* name) { return equalIgnoringCase(token.name, name); });
  }

  std::size_t endOf(const Token& token) const {
    if (!token.node)
      return token.offset + 2;
    if (token.kind == Token::Kind::comment)
      return token.offset + token.node->v.text.original_text.length;
    const GumboElement& element = token.node->v.element;
    return token.offset + (token.kind == Token::Kind::start ? element.original_tag : element.original_end_tag).length;
  }

  std::string_view nameAt(std::size_t at) const {
    std::size_t end = at;
    while (end < html_.size() && isNameCharacter(html_[end], end == at))
      ++end;
    return html_.substr(at, end - at);
  }

  std::string_view html_;
  std::size_t begin_;
  std::vector<Token> tokens_;
};

/// Nests the tokens of one <x3d> element.
class PageBuilder {
public:
  PageBuilder(std::string_view html, const std::string& name) : html_(html), name_(name) {}

  X3dElement build(const std::vector<Token>& tokens) {
    open_.push_back(built_.document);
    for (const Token& token : tokens) {
      if (isComplete_)
        furtherX3d_ += token.kind == Token::Kind::start && equalIgnoringCase(token.name, x3dName);
      else if (token.offset > lastOffset_ || !hasBegun()) // gumbo's copies of formatting elements have the same offset
        add(token, tokens[0].offset);
      lastOffset_ = token.offset;
    }
    addWarnings(tokens[0].offset);
    return std::move(built_);
  }

private:
  bool hasBegun() const { return open_.size() > 1; }

  void add(const Token& token, std::size_t x3dOffset) {
    switch (token.kind) {
    case Token::Kind::comment:
      open_.back().append_child(pugi::node_comment).set_value(token.node->v.text.text);
      break;
    case Token::Kind::start:
      begin(token);
      break;
    case Token::Kind::end: {
      const auto found = std::find_if(open_.rbegin(), open_.rend() - 1, [&](const pugi::xml_node& element) {
        return equalIgnoringCase(element.name(), token.name);
      });
      if (found != open_.rend() - 1)
        open_.erase(found.base() - 1, open_.end());
      else // the end of an element of HTML around <x3d>
        isCutOff_ = token.node && isKnownToGumbo(*token.node) && token.node->v.element.start_pos.offset < x3dOffset;
      isComplete_ = !hasBegun() || isCutOff_;
    }
    }
  }

  void begin(const Token& token) {
    if (!isXmlName(token.name))
      return;
    if (open_.size() > maxPageDepth)
      throw Error(ErrorKind::limit, locationOf(html_, name_, token.offset),
                  "elements are nested too deeply; in HTML each needs an end tag, since \"/>\" ends none");
    const GumboElement& element = token.node->v.element;
    pugi::xml_node& parent = open_.back();
    if (hasBegun() && endsWithSlash_.contains(parent.internal_object()) && !parent.first_child()) {
      ++slashed_;
      firstSlashed_ = slashed_ == 1 ? built_.offsets.of(parent) : firstSlashed_;
    }
    pugi::xml_node child = parent.append_child(std::string(token.name).c_str());
    built_.offsets.add(child, token.offset);
    for (unsigned i = 0; i < element.attributes.length; ++i) {
      const auto& attribute = *static_cast<const GumboAttribute*>(element.attributes.data[i]);
      if (const std::string_view name = textOf(attribute.original_name); isXmlName(name))
        child.append_attribute(std::string(name).c_str()).set_value(attribute.value);
    }
    if (isVoid(token.name))
      return;
    if (textOf(element.original_tag).ends_with("/>"))
      endsWithSlash_.insert(child.internal_object());
    open_.push_back(child);
  }

  /// "index.html:12": without the folder, which may be a temporary one.
  std::string locationOfByte(std::size_t offset) const {
    return locationOf(html_, std::filesystem::path(name_).filename(), offset);
  }

  void addWarnings(std::size_t x3dOffset) {
    if (!isComplete_ || isCutOff_)
      built_.warnings.push_back(locationOfByte(x3dOffset) +
                                ": the <x3d> element has no end tag; the page may be cut off.");
    if (slashed_ > 0)
      built_.warnings.push_back(locationOfByte(firstSlashed_) + ": " +
                                (slashed_ == 1 ? "an element ends" : std::to_string(slashed_) + " elements end") +
                                " with \"/>\", which HTML ignores: what follows lies inside.");
    if (furtherX3d_ > 0)
      built_.warnings.push_back(locationOfByte(x3dOffset) + ": this is the first <x3d> element of " +
                                std::to_string(furtherX3d_ + 1) + "; the others are not read.");
  }

  std::string_view html_;
  const std::string& name_;
  X3dElement built_;
  std::vector<pugi::xml_node> open_; ///< the document and the open elements
  std::set<pugi::xml_node_struct*> endsWithSlash_;
  std::size_t lastOffset_ = 0, slashed_ = 0, firstSlashed_ = 0, furtherX3d_ = 0;
  bool isComplete_ = false, isCutOff_ = false;
};

/// The first element of a name in the order of the text; null where there is none.
const GumboNode* firstElement(const GumboNode& root, std::string_view name) {
  const GumboNode* first = nullptr;
  std::vector<const GumboNode*> waiting{&root};
  while (!waiting.empty()) {
    const GumboNode& node = *waiting.back();
    waiting.pop_back();
    if (node.type == GUMBO_NODE_ELEMENT && equalIgnoringCase(tagNameOf(node.v.element.original_tag), name) &&
        (!first || node.v.element.start_pos.offset < first->v.element.start_pos.offset))
      first = &node;
    if (const GumboVector* children = Tokens::childrenOf(node))
      for (unsigned i = 0; i < children->length; ++i)
        waiting.push_back(static_cast<const GumboNode*>(children->data[i]));
  }
  return first;
}

/// The text that an element begins with, without white space around it.
std::string textIn(const GumboNode& element) {
  const GumboVector& children = element.v.element.children;
  const auto* const text = children.length > 0 ? static_cast<const GumboNode*>(children.data[0]) : nullptr;
  if (!text || text->type != GUMBO_NODE_TEXT)
    return "";
  std::string_view trimmed = text->v.text.text;
  constexpr std::string_view space = " \t\r\n\f";
  trimmed.remove_prefix(std::min(trimmed.find_first_not_of(space), trimmed.size()));
  return std::string(trimmed.substr(0, trimmed.find_last_not_of(space) + 1));
}

/// gumbo's tree, whose memory is `memory`; null at a limit.
const GumboOutput* parse(std::string_view html, GumboMemory& memory) {
  GumboOptions options = kGumboDefaultOptions;
  options.allocator = GumboMemory::allocate;
  options.deallocator = GumboMemory::release;
  options.userdata = &memory;
  options.max_errors = 0;
  if (setjmp(memory.exhausted) != 0)
    return nullptr;
  return gumbo_parse_with_options(&options, html.data(), html.size());
}

} // namespace

X3dElement parsePage(std::string_view html, const std::string& name) {
  if (html.size() > maxPageBytes)
    throw Error(ErrorKind::limit, name, "the page is larger than 64 MiB");
  GumboMemory memory(maxPageTreeBytes, maxPageSeconds);
  const GumboOutput* const page = parse(html, memory);
  if (!page)
    throw Error(ErrorKind::limit, name, "the page takes more than 1 GiB of memory, or more than 60 s, to be parsed");
  const GumboNode* const x3d = firstElement(*page->document, x3dName);
  if (!x3d)
    throw Error(ErrorKind::malformed, name, "there is no <X3D> element");
  X3dElement element = PageBuilder(html, name).build(Tokens(html, *page->document, *x3d).inOrder());
  if (const GumboNode* const title = firstElement(*page->document, "title"))
    element.pageTitle = textIn(*title);
  return element;
}

} // namespace imgeo
