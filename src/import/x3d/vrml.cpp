// Classic VRML -> the elements that the XML encoding of the same document has.
// VRML needs no table of nodes to be read: what a value is shows in its first word.

#include "import/text_scanner.h"
#include "import/x3d/elements.h"
#include "import/x3d/vrml_names.h"
#include "import/x3d/vrml_tokens.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <map>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxDepth = 200;

/// A DEF of one scope: the document, or the body of a prototype.
struct Named {
  std::string name; ///< its own, or one with a number where that was given before
  std::string element;
};

struct Scope {
  std::map<std::string, Named, std::less<>> names;
  std::map<std::string, std::size_t, std::less<>> timesGiven;
  std::map<std::string, pugi::xml_node, std::less<>> prototypes; ///< declarations by name
};

/// Where a value goes: an attribute of an element, or nodes below it.
struct Target {
  pugi::xml_node element;
  std::string attribute;
  std::string containerField; ///< of nodes; "" where it is not said
  bool isStringList = false, isNodes = false;
};

bool isNodesType(std::string_view type) {
  return type == "SFNode" || type == "MFNode";
}

class VrmlParser {
public:
  VrmlParser(std::string_view text, const std::string& name) : tokens_(text, name), text_(text) {}

  Elements parse() {
    readHeader();
    while (!tokens_.nextIs(TokenKind::end))
      readStatement(scene_, "children");
    addComments(scene_);
    return std::move(elements_);
  }

private:
  // "#VRML V2.0 utf8" and "#X3D V3.3 utf8" are comments to all but this.
  void readHeader() {
    pugi::xml_node x3d = add(elements_.document, "X3D", tokens_.next());
    const std::string_view line = text_.substr(0, text_.find_first_of("\r\n"));
    const bool isX3d = line.starts_with("#X3D V");
    if (line.starts_with("#VRML V1"))
      tokens_.fail({}, ErrorKind::unsupported, "is VRML 1.0; imgeo reads VRML97 (VRML 2.0) and X3D");
    if (!isX3d && !line.starts_with("#VRML V2"))
      tokens_.fail({}, ErrorKind::malformed,
                   "begins neither with \"#VRML V2.0 utf8\" nor with \"#X3D V3\" or \"#X3D V4\"");
    elements_.format = isX3d ? "X3D Classic" : "VRML97";
    std::string version = isX3d ? std::string(line.substr(6, line.find(' ', 6) - 6)) : "3.3";
    if (!std::ranges::all_of(version, [](unsigned char c) { return std::isdigit(c) || c == '.'; }))
      version = "3.3";
    x3d.append_attribute("profile") = "Immersive"; // which is VRML97 and what came since
    x3d.append_attribute("version") = version.c_str();
    x3d_ = x3d;
    head_ = x3d.append_child("head");
    scene_ = x3d.append_child("Scene");
    scopes_.emplace_back();
    std::vector<std::string_view> comments = tokens_.takeComments();
    if (!comments.empty())
      comments.erase(comments.begin());
    addComments(scene_, comments);
  }

  pugi::xml_node add(pugi::xml_node parent, std::string_view element, const Token& where) {
    requireName(where, element);
    pugi::xml_node added = parent.append_child(std::string(element).c_str());
    elements_.offsets[added.internal_object()] = where.offset;
    return added;
  }

  /// Names of nodes and fields become those of elements and attributes.
  void requireName(const Token& where, std::string_view name) const {
    const auto isLetter = [](unsigned char c) { return std::isalpha(c) || c == '_' || c >= 0x80; };
    const auto isInner = [&](unsigned char c) { return isLetter(c) || std::isdigit(c) || c == '-'; };
    if (name.empty() || !isLetter(static_cast<unsigned char>(name[0])) || !std::ranges::all_of(name, isInner))
      tokens_.fail(where, ErrorKind::malformed,
                   fmt::format("\"{}\" is no name of a node or field", asPrintable(name)));
  }

  static void set(pugi::xml_node element, std::string_view attribute, std::string_view value) {
    const std::string name(attribute);
    pugi::xml_attribute at = element.attribute(name.c_str());
    if (!at)
      at = element.append_attribute(name.c_str());
    at.set_value(std::string(value).c_str());
  }

  void addComments(pugi::xml_node parent) { addComments(parent, tokens_.takeComments()); }
  static void addComments(pugi::xml_node parent, const std::vector<std::string_view>& comments) {
    for (const std::string_view comment : comments)
      parent.append_child(pugi::node_comment).set_value(std::string(comment).c_str());
  }

  std::string takeWord(const char* what) { return std::string(tokens_.take(TokenKind::word, what).text); }

  /// A node or what else may stand among nodes.
  void readStatement(pugi::xml_node parent, std::string_view field) {
    addComments(parent);
    const Token token = tokens_.take(TokenKind::word, "a node");
    if (token.text == "DEF") {
      const std::string name = takeWord("a name");
      readNode(parent, field, tokens_.take(TokenKind::word, "a node"), name);
    } else if (token.text == "USE") {
      readUse(parent, field, token);
    } else if (token.text == "ROUTE") {
      readRoute(parent, token);
    } else if (token.text == "PROTO") {
      readPrototype(parent, token);
    } else if (token.text == "EXTERNPROTO") {
      readExternPrototype(parent, token);
    } else if (!readOfDocument(token)) {
      readNode(parent, field, token, "");
    }
  }

  /// Statements of X3D that say something of the whole document.
  bool readOfDocument(const Token& token) {
    const std::string_view word = token.text;
    if (word == "PROFILE") {
      set(x3d_, "profile", takeWord("a profile"));
    } else if (word == "COMPONENT") {
      const std::string component = takeWord("a component");
      const std::size_t colon = std::min(component.find(':'), component.size());
      pugi::xml_node element = add(head_, "component", token);
      set(element, "name", component.substr(0, colon));
      set(element, "level", colon < component.size() ? component.substr(colon + 1) : "1");
    } else if (word == "META") {
      pugi::xml_node element = add(head_, "meta", token);
      set(element, "name", unescaped(tokens_.take(TokenKind::string, "a name in quotes").text));
      set(element, "content", unescaped(tokens_.take(TokenKind::string, "a value in quotes").text));
    } else if (word == "UNIT") {
      pugi::xml_node element = add(head_, "unit", token);
      set(element, "category", takeWord("a category"));
      set(element, "name", takeWord("a name"));
      set(element, "conversionFactor", tokens_.take(TokenKind::number, "a number").text);
    } else if (word == "IMPORT" || word == "EXPORT") {
      readExchange(token);
    } else {
      return false;
    }
    return true;
  }

  /// IMPORT Inline.name AS own; EXPORT name AS other.
  void readExchange(const Token& token) {
    const bool isImport = token.text == "IMPORT";
    pugi::xml_node element = add(scene_, token.text, token);
    std::string name = takeWord("a name");
    if (isImport) {
      const auto [inlined, inner] = split(name, token);
      set(element, "inlineDEF", inlined);
      name = inner;
    }
    set(element, isImport ? "importedDEF" : "localDEF", name);
    if (tokens_.nextIs("AS")) {
      tokens_.take();
      set(element, "AS", takeWord("a name"));
    }
  }

  std::pair<std::string, std::string> split(const std::string& text, const Token& where) const {
    const std::size_t dot = text.find('.');
    if (dot == text.npos)
      tokens_.fail(where, ErrorKind::malformed, fmt::format("\"{}\" has no dot", asPrintable(text)));
    return {text.substr(0, dot), text.substr(dot + 1)};
  }

  void readRoute(pugi::xml_node parent, const Token& token) {
    pugi::xml_node route = add(parent, "ROUTE", token);
    const auto [from, fromField] = split(takeWord("a node's field"), token);
    if (takeWord("TO") != "TO")
      tokens_.fail(token, ErrorKind::malformed, "the ROUTE that begins here has no TO");
    const auto [to, toField] = split(takeWord("a node's field"), token);
    set(route, "fromNode", currentName(from));
    set(route, "fromField", fromField);
    set(route, "toNode", currentName(to));
    set(route, "toField", toField);
  }

  std::string currentName(const std::string& name) const {
    const auto found = scopes_.back().names.find(name);
    return found == scopes_.back().names.end() ? name : found->second.name;
  }

  void readUse(pugi::xml_node parent, std::string_view field, const Token& token) {
    const std::string name = takeWord("a name");
    const auto found = scopes_.back().names.find(name);
    const bool isKnown = found != scopes_.back().names.end();
    pugi::xml_node element = add(parent, isKnown ? found->second.element : "Group", token);
    setContainerField(element, field);
    set(element, "USE", isKnown ? found->second.name : name);
  }

  void setContainerField(pugi::xml_node element, std::string_view field) {
    if (!field.empty() && field != defaultContainerField(element.name()) &&
        element.name() != std::string_view("ProtoInstance"))
      set(element, "containerField", field);
  }

  /// A name that is given again stands for the later node from there on.
  std::string define(const std::string& name, const std::string& element) {
    Scope& scope = scopes_.back();
    const std::size_t times = ++scope.timesGiven[name];
    const std::string own = times == 1 ? name : fmt::format("{}-{}", name, times);
    scope.names[name] = {own, element};
    return own;
  }

  void readNode(pugi::xml_node parent, std::string_view field, const Token& type, const std::string& name) {
    if (++depth_ > maxDepth)
      tokens_.fail(type, ErrorKind::limit, "nodes are nested too deeply");
    const auto prototype = scopes_.back().prototypes.find(type.text);
    const bool isInstance = prototype != scopes_.back().prototypes.end();
    pugi::xml_node element = add(parent, isInstance ? "ProtoInstance" : type.text, type);
    setContainerField(element, field);
    if (isInstance) {
      set(element, "name", type.text);
      if (!field.empty() && field != "children")
        set(element, "containerField", field);
    }
    if (!name.empty())
      set(element, "DEF", define(name, element.name()));
    tokens_.take(TokenKind::openNode, "{");
    while (!tokens_.nextIs(TokenKind::closeNode))
      readBodyPart(element, isInstance ? prototype->second : pugi::xml_node());
    addComments(element);
    tokens_.take();
    --depth_;
  }

  void readBodyPart(pugi::xml_node element, pugi::xml_node prototype) {
    const bool isStatement =
        tokens_.nextIs("ROUTE") || tokens_.nextIs("PROTO") || tokens_.nextIs("EXTERNPROTO");
    if (isStatement)
      return readStatement(element, "");
    const Token token = tokens_.take(TokenKind::word, "a field or }");
    if (declaresFields(element.name()) && !accessTypeOf(token.text).empty())
      return readDeclaration(element, token, true);
    requireName(token, token.text);
    if (prototype)
      return readFieldOfInstance(element, token, prototype);
    const std::string field(currentFieldName(element.name(), token.text));
    if (tokens_.nextIs("IS"))
      return readConnection(element, field, token);
    readValue({element, field, field, isStringList(element.name(), field), isNodeList(field)});
  }

  void readFieldOfInstance(pugi::xml_node element, const Token& field, pugi::xml_node prototype) {
    if (tokens_.nextIs("IS"))
      return readConnection(element, std::string(field.text), field);
    const std::string name(field.text);
    const pugi::xml_node interface =
        prototype.child("ProtoInterface") ? prototype.child("ProtoInterface") : prototype;
    const std::string type =
        interface.find_child_by_attribute("field", "name", name.c_str()).attribute("type").value();
    pugi::xml_node value = add(element, "fieldValue", field);
    set(value, "name", name);
    readValue({value, "value", "", type == "MFString", isNodesType(type)});
  }

  /// field IS field-of-the-prototype
  void readConnection(pugi::xml_node element, const std::string& field, const Token& where) {
    tokens_.take();
    pugi::xml_node is = element.child("IS");
    if (!is)
      is = add(element, "IS", where);
    pugi::xml_node connect = add(is, "connect", where);
    set(connect, "nodeField", field);
    set(connect, "protoField", takeWord("a field of the prototype"));
  }

  /// accessType type name, and a value where it has one.
  void readDeclaration(pugi::xml_node parent, const Token& access, bool hasValues) {
    const std::string accessType(accessTypeOf(access.text)), type = takeWord("a type"),
                                                             name = takeWord("a name");
    pugi::xml_node field = add(parent, "field", access);
    set(field, "accessType", accessType);
    set(field, "type", type);
    set(field, "name", name);
    if (tokens_.nextIs("IS"))
      readConnection(parent, name, access);
    else if (hasValues && (accessType == "initializeOnly" || accessType == "inputOutput"))
      readValue({field, "value", "", type == "MFString", isNodesType(type)});
  }

  void readDeclarations(pugi::xml_node parent, bool hasValues) {
    tokens_.take(TokenKind::openList, "[");
    while (!tokens_.nextIs(TokenKind::closeList)) {
      const Token access = tokens_.take(TokenKind::word, "a field's declaration or ]");
      if (accessTypeOf(access.text).empty())
        tokens_.fail(access, ErrorKind::malformed,
                     fmt::format("\"{}\" begins no declaration of a field", asPrintable(access.text)));
      readDeclaration(parent, access, hasValues);
    }
    tokens_.take();
  }

  void readPrototype(pugi::xml_node parent, const Token& token) {
    if (++depth_ > maxDepth)
      tokens_.fail(token, ErrorKind::limit, "prototypes are nested too deeply");
    const std::string name = takeWord("a name");
    pugi::xml_node declaration = add(parent, "ProtoDeclare", token);
    set(declaration, "name", name);
    readDeclarations(add(declaration, "ProtoInterface", token), true);
    pugi::xml_node body = add(declaration, "ProtoBody", token);
    tokens_.take(TokenKind::openNode, "{");
    Scope inner;
    inner.prototypes = scopes_.back().prototypes;
    scopes_.push_back(std::move(inner));
    while (!tokens_.nextIs(TokenKind::closeNode))
      readStatement(body, "");
    tokens_.take();
    scopes_.pop_back();
    scopes_.back().prototypes[name] = declaration;
    --depth_;
  }

  void readExternPrototype(pugi::xml_node parent, const Token& token) {
    const std::string name = takeWord("a name");
    pugi::xml_node declaration = add(parent, "ExternProtoDeclare", token);
    set(declaration, "name", name);
    readDeclarations(declaration, false);
    readValue({declaration, "url", "", true, false});
    scopes_.back().prototypes[name] = declaration;
  }

  /// Numbers, strings, truth values or nodes; one of them, or a list in brackets.
  void readValue(const Target& target) {
    if (!tokens_.nextIs(TokenKind::openList))
      return readItems(target, target.isStringList, false);
    tokens_.take();
    if (!tokens_.nextIs(TokenKind::closeList))
      readItems(target, true, true);
    else if (!target.isNodes)
      set(target.element, target.attribute, "");
    tokens_.take(TokenKind::closeList, "a value or ]");
  }

  void readItems(const Target& target, bool isStringList, bool isList) {
    std::string text;
    const auto isValue = [&] {
      return tokens_.nextIs(TokenKind::number) || tokens_.nextIs("TRUE") || tokens_.nextIs("FALSE");
    };
    if (tokens_.nextIs(TokenKind::string)) {
      if (!isStringList)
        return set(target.element, target.attribute, unescaped(tokens_.take().text));
      do
        (text += text.empty() ? "\"" : " \"").append(tokens_.take().text).append("\"");
      while (isList && tokens_.nextIs(TokenKind::string));
    } else if (isValue()) {
      do {
        const std::string_view word = tokens_.take().text;
        text.append(text.empty() ? "" : " ")
            .append(word == "TRUE"    ? "true"
                    : word == "FALSE" ? "false"
                                      : word);
      } while (isValue());
    } else {
      return readNodes(target, isList);
    }
    set(target.element, target.attribute, text);
  }

  void readNodes(const Target& target, bool isList) {
    if (!tokens_.nextIs(TokenKind::word))
      tokens_.failExpecting("a value of " + target.attribute);
    do {
      if (tokens_.nextIs("NULL"))
        tokens_.take();
      else
        readStatement(target.element, target.containerField);
    } while (isList && tokens_.nextIs(TokenKind::word));
  }

  VrmlTokens tokens_;
  std::string_view text_;
  Elements elements_;
  pugi::xml_node x3d_, head_, scene_;
  std::vector<Scope> scopes_;
  std::size_t depth_ = 0;
};

} // namespace

Elements parseVrml(std::string_view text, const std::string& name) {
  return VrmlParser(text, name).parse();
}

} // namespace imgeo::x3d
