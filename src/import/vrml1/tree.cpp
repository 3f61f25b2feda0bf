#include "import/vrml1/tree.h"

#include "import/text/text_scanner.h"
#include "import/vrml1/node_types.h"
#include "import/x3d/elements.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>

namespace imgeo::vrml1 {

namespace {

using x3d::Token;
using x3d::TokenKind;
using x3d::VrmlTokens;

constexpr std::size_t maxDepth = 200;

/// A number in decimal or, in images, in hexadecimal notation; empty for a word that is no number or not finite in
/// single precision.
std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+'))
    word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  if (word.starts_with("0x") || word.starts_with("0X")) {
    std::uint32_t bits = 0;
    const auto [stop, error] = std::from_chars(word.data() + 2, end, bits, 16);
    return error == std::errc() && stop == end ? std::optional<double>(bits) : std::nullopt;
  }
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument)
    return {};
  if (error == std::errc::result_out_of_range) { // too large, or smaller than any number but 0
    const std::size_t exponent = word.find_first_of("eE");
    return exponent != word.npos && word.substr(exponent + 1).starts_with('-') ? std::optional(0.0) : std::nullopt;
  }
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) ? std::optional(value)
                                                                                   : std::nullopt;
}

bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    std::size_t continuationBytes = lead < 0x80                   ? 0
                                    : lead >= 0xc2 && lead < 0xe0 ? 1
                                    : lead >= 0xe0 && lead < 0xf0 ? 2
                                                                  : 3;
    if ((lead >= 0x80 && lead < 0xc2) || lead > 0xf4)
      return false;
    for (; continuationBytes > 0; --continuationBytes, ++i)
      if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
        return false;
  }
  return true;
}

/// The text in UTF-8. The format is ASCII; files with other bytes were written in Latin-1.
std::string inUtf8(std::string text) {
  if (isUtf8(text))
    return text;
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xc0 | (byte >> 6));
      utf8 += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return utf8;
}

/// Whether the values of a field are text, which old exporters write without quotes: "filename wood.gif".
bool isText(std::string_view field) {
  return field == "name" || field == "filename" || field == "string" || field == "description";
}

class TreeParser {
public:
  TreeParser(VrmlTokens& tokens, Report& report) : tokens_(tokens), report_(report) {}

  Tree parse() {
    Node root;
    root.type = "Separator";
    root.where = tokens_.next();
    while (!tokens_.nextIs(TokenKind::end))
      readChild(root, tokens_.take(TokenKind::word, "a node"));
    tree_.nodes.push_back(std::move(root));
    return std::move(tree_);
  }

private:
  std::string takeName() {
    if (!tokens_.nextIs(TokenKind::number)) // VRML 1.0 forbids names that begin with a digit; exporters write them
      return inUtf8(std::string(tokens_.take(TokenKind::word, "a name").text));
    return std::string(tokens_.take().text);
  }

  /// Reads a DEF, a USE or a node, whose first word is `word`.
  void readChild(Node& parent, const Token& word) {
    if (word.text == "USE") {
      const std::string name = takeName();
      if (const auto found = definitions_.find(name); found != definitions_.end())
        addChild(parent, *found->second);
      else
        report_.omissions.push_back(
            fmt::format("{}: left out: USE {} names no DEF.", tokens_.locationOf(word), asPrintable(name)));
    } else if (word.text == "DEF") {
      const std::string name = takeName();
      const Token type = tokens_.take(TokenKind::word, "a node");
      addChild(parent, readNode(type, name));
    } else {
      addChild(parent, readNode(word, ""));
    }
  }

  static void addChild(Node& parent, const Node& child) {
    parent.children.push_back(&child);
    parent.draws |= child.draws;
    parent.lightsSiblings |= child.lightsSiblings;
  }

  const Node& readNode(const Token& type, const std::string& name) {
    if (++depth_ > maxDepth)
      tokens_.fail(type, ErrorKind::limit, "nodes are nested too deeply");
    tokens_.take(TokenKind::openNode, "{");
    Node node;
    node.type = type.text;
    node.name = name;
    node.where = type;
    while (!tokens_.nextIs(TokenKind::closeNode))
      readBodyStatement(node);
    tokens_.take();
    --depth_;
    replaceExtension(node);
    node.lightsSiblings = isLight(node.type) || (node.lightsSiblings && !restoresState(node.type));
    node.draws |= isShape(node.type) || isLight(node.type) || isCamera(node.type) || node.is("WWWInline");
    tree_.nodes.push_back(std::move(node));
    if (!name.empty())
      definitions_[name] = &tree_.nodes.back(); // after its children: no node contains itself
    return tree_.nodes.back();
  }

  /// Gives an extension node the type that its isA names. Reports unknown nodes and fields.
  void replaceExtension(Node& node) {
    if (!isNodeType(node.type)) {
      const Field* const types = node.field("isA");
      const auto known =
          types ? std::ranges::find_if(types->words, isNodeType) : std::vector<std::string>::const_iterator();
      if (!types || known == types->words.end()) {
        ++report_.unknownNodes[asPrintable(node.type)];
        return;
      }
      node.type = *known;
    }
    for (const Field& field : node.fields)
      if (!hasField(node.type, field.name) && field.name != "isA")
        ++report_.unknownFields[fmt::format("{}.{}", node.type, asPrintable(field.name))];
  }

  void readBodyStatement(Node& node) {
    const Token word = tokens_.take(TokenKind::word, "a field, a node or }");
    if (word.text == "fields")
      skipDeclarations();
    else if (word.text == "DEF" || word.text == "USE" || tokens_.nextIs(TokenKind::openNode))
      readChild(node, word);
    else
      readField(node, word);
  }

  /// Skips "[ SFFloat size, MFString title ]": the types of values are recognized without it.
  void skipDeclarations() {
    tokens_.take(TokenKind::openList, "[");
    while (!tokens_.nextIs(TokenKind::closeList))
      tokens_.take(TokenKind::word, "a field's type or name or ]");
    tokens_.take();
  }

  void readField(Node& node, const Token& name) {
    Field field{name.text, {}, {}};
    if (tokens_.nextIs(TokenKind::openList)) {
      tokens_.take();
      while (!tokens_.nextIs(TokenKind::closeList))
        readItem(node, field);
      tokens_.take();
    } else if (tokens_.nextIs(TokenKind::number) && !isText(name.text)) {
      while (tokens_.nextIs(TokenKind::number))
        readItem(node, field);
    } else if (tokens_.next().text.starts_with('(') && tokens_.nextIs(TokenKind::word)) {
      for (bool isLast = false; !isLast;) { // "(SIDES | TOP)"
        isLast = tokens_.next().text.ends_with(')');
        addFlags(field, tokens_.take(TokenKind::word, "a word or )").text);
      }
    } else {
      readItem(node, field);
    }
    node.fields.push_back(std::move(field));
  }

  /// Reads a number, a string, a word, or a node, which unknown nodes have as values.
  void readItem(Node& node, Field& field) {
    if (tokens_.nextIs(TokenKind::string)) {
      field.words.push_back(inUtf8(x3d::unescaped(tokens_.take().text)));
    } else if (tokens_.nextIs(TokenKind::number)) {
      const Token token = tokens_.take();
      const std::optional<double> number = numberOf(token.text);
      if (isText(field.name))
        field.words.push_back(inUtf8(std::string(token.text)));
      else if (number)
        field.numbers.push_back(*number);
      else
        tokens_.fail(token, ErrorKind::malformed, fmt::format("\"{}\" is no number", asPrintable(token.text)));
    } else {
      const Token word = tokens_.take(TokenKind::word, "a value");
      if (word.text == "DEF" || word.text == "USE" || tokens_.nextIs(TokenKind::openNode))
        readChild(node, word);
      else
        field.words.push_back(inUtf8(std::string(word.text)));
    }
  }

  static void addFlags(Field& field, std::string_view text) {
    constexpr std::string_view separators = "(|)";
    for (std::size_t at = text.find_first_not_of(separators); at != text.npos;) {
      const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
      field.words.emplace_back(text.substr(at, end - at));
      at = text.find_first_not_of(separators, end);
    }
  }

  VrmlTokens& tokens_;
  Report& report_;
  Tree tree_;
  std::map<std::string, const Node*, std::less<>> definitions_; ///< the latest by name
  std::size_t depth_ = 0;
};

} // namespace

const Field* Node::field(std::string_view fieldName) const {
  const auto found = std::ranges::find(fields, fieldName, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

double Node::real(std::string_view fieldName, double fallback) const {
  const std::vector<double>& values = numbers(fieldName);
  return values.empty() ? fallback : values[0];
}

Vec3d Node::vector(std::string_view fieldName, Vec3d fallback) const {
  const std::vector<double>& v = numbers(fieldName);
  return v.size() < 3 ? fallback : Vec3d{v[0], v[1], v[2]};
}

const std::vector<double>& Node::numbers(std::string_view fieldName) const {
  static const std::vector<double> none;
  const Field* const found = field(fieldName);
  return found ? found->numbers : none;
}

std::string Node::word(std::string_view fieldName, std::string_view fallback) const {
  const Field* const found = field(fieldName);
  return found && !found->words.empty() ? found->words[0] : std::string(fallback);
}

bool Node::boolean(std::string_view fieldName, bool fallback) const {
  const Field* const found = field(fieldName);
  if (found && !found->numbers.empty())
    return found->numbers[0] != 0; // Inventor writes 0 and 1 too
  return found && !found->words.empty() ? found->words[0] == "TRUE" : fallback;
}

Tree parseTree(VrmlTokens& tokens, Report& report) {
  return TreeParser(tokens, report).parse();
}

} // namespace imgeo::vrml1
