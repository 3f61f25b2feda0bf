// The syntax of a value shows its type, so that parsing needs no table of all fields; names.h has the exceptions.
#include "import/text/text_scanner.h"
#include "import/vrml/elements.h"
#include "import/vrml/names.h"
#include "import/vrml/tokens.h"
#include "import/x3d/elements.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <map>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxDepth = 200;

/// The destination of a value: an attribute of an element, or child nodes.
struct Target {
  pugi::xml_node element;
  std::string attribute;
  std::string containerField; ///< of child nodes; "" for the default
  bool isStringList = false, isNodes = false;
};

bool isNodesType(std::string_view type) {
  return type == "SFNode" || type == "MFNode";
}

/// Whether a token can be the type of a field that a node declares.
bool isFieldType(const Token& token) {
  return token.kind == TokenKind::word && (token.text.starts_with("SF") || token.text.starts_with("MF"));
}

class VrmlParser {
public:
  VrmlParser(std::string_view text, const std::string& name) : tokens_(text, name), text_(text), elements_(tokens_) {}

  Elements parse() {
    readHeader();
    while (!tokens_.nextIs(TokenKind::end))
      readStatement(scene_, "children");
    addComments(scene_);
    return elements_.take();
  }

private:
  /// Reads the header, "#VRML V2.0 utf8" or "#X3D V3.3 utf8", which the tokenizer skips as a comment.
  void readHeader() {
    pugi::xml_node x3d = elements_.add(elements_.top(), "X3D", tokens_.next());
    const std::string_view line = text_.substr(0, text_.find_first_of("\r\n"));
    const bool isX3d = line.starts_with("#X3D V");
    if (!isX3d && !line.starts_with("#VRML V2"))
      tokens_.fail({}, ErrorKind::malformed,
                   "begins neither with \"#VRML V2.0 utf8\" nor with \"#X3D V3\" or \"#X3D V4\"");
    elements_.setFormat(isX3d ? "X3D Classic" : "VRML97");
    std::string version = isX3d ? std::string(line.substr(6, line.find(' ', 6) - 6)) : "3.3";
    if (!std::ranges::all_of(version, [](unsigned char c) { return std::isdigit(c) || c == '.'; }))
      version = "3.3";
    x3d.append_attribute("profile") = "Immersive"; // a superset of VRML97
    x3d.append_attribute("version") = version.c_str();
    x3d_ = x3d;
    head_ = x3d.append_child("head");
    scene_ = x3d.append_child("Scene");
    std::vector<std::string_view> comments = tokens_.takeComments();
    if (!comments.empty())
      comments.erase(comments.begin());
    x3d::addComments(scene_, comments);
  }

  void addComments(pugi::xml_node parent) { x3d::addComments(parent, tokens_.takeComments()); }

  std::string takeWord(const char* what) { return std::string(tokens_.take(TokenKind::word, what).text); }

  /// Reads a node or another statement.
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
    } else if (!readDocumentStatement(token)) {
      readNode(parent, field, token, "");
    }
  }

  /// Reads an X3D statement about the whole document; returns false for other words.
  bool readDocumentStatement(const Token& token) {
    const std::string_view word = token.text;
    if (word == "PROFILE") {
      set(x3d_, "profile", takeWord("a profile"));
    } else if (word == "COMPONENT") {
      const std::string component = takeWord("a component");
      const std::size_t colon = std::min(component.find(':'), component.size());
      pugi::xml_node element = elements_.add(head_, "component", token);
      set(element, "name", component.substr(0, colon));
      set(element, "level", colon < component.size() ? component.substr(colon + 1) : "1");
    } else if (word == "META") {
      pugi::xml_node element = elements_.add(head_, "meta", token);
      set(element, "name", unescaped(tokens_.take(TokenKind::string, "a name in quotes").text));
      set(element, "content", unescaped(tokens_.take(TokenKind::string, "a value in quotes").text));
    } else if (word == "UNIT") {
      pugi::xml_node element = elements_.add(head_, "unit", token);
      set(element, "category", takeWord("a category"));
      set(element, "name", takeWord("a name"));
      set(element, "conversionFactor", tokens_.take(TokenKind::number, "a number").text);
    } else if (word == "IMPORT" || word == "EXPORT") {
      readImportOrExport(token);
    } else {
      return false;
    }
    return true;
  }

  /// Reads "IMPORT inline.name AS importedName" or "EXPORT name AS exportedName".
  void readImportOrExport(const Token& token) {
    const bool isImport = token.text == "IMPORT";
    pugi::xml_node element = elements_.add(scene_, token.text, token);
    std::string name = takeWord("a name");
    if (isImport) {
      const auto [inlined, inner] = splitAtDot(name, token);
      set(element, "inlineDEF", inlined);
      name = inner;
    }
    set(element, isImport ? "importedDEF" : "localDEF", name);
    if (tokens_.nextIs("AS")) {
      tokens_.take();
      set(element, "AS", takeWord("a name"));
    }
  }

  std::pair<std::string, std::string> splitAtDot(const std::string& text, const Token& where) const {
    const std::size_t dot = text.find('.');
    if (dot == text.npos)
      tokens_.fail(where, ErrorKind::malformed, fmt::format("\"{}\" has no dot", asPrintable(text)));
    return {text.substr(0, dot), text.substr(dot + 1)};
  }

  void readRoute(pugi::xml_node parent, const Token& token) {
    pugi::xml_node route = elements_.add(parent, "ROUTE", token);
    const auto [from, fromField] = splitAtDot(takeWord("a node's field"), token);
    if (takeWord("TO") != "TO")
      tokens_.fail(token, ErrorKind::malformed, "the ROUTE that begins here has no TO");
    const auto [to, toField] = splitAtDot(takeWord("a node's field"), token);
    set(route, "fromNode", elements_.currentName(from));
    set(route, "fromField", fromField);
    set(route, "toNode", elements_.currentName(to));
    set(route, "toField", toField);
  }

  void readUse(pugi::xml_node parent, std::string_view field, const Token& token) {
    const std::string name = takeWord("a name");
    const VrmlElements::Definition* known = elements_.definition(name);
    pugi::xml_node element = elements_.add(parent, known ? known->element : "Group", token);
    setContainerField(element, field);
    set(element, "USE", known ? known->name : name);
  }

  void readNode(pugi::xml_node parent, std::string_view field, const Token& type, const std::string& name) {
    if (++depth_ > maxDepth)
      tokens_.fail(type, ErrorKind::limit, "nodes are nested too deeply");
    const pugi::xml_node prototype = elements_.prototype(type.text);
    const bool isInstance = !prototype.empty();
    pugi::xml_node element = elements_.add(parent, isInstance ? "ProtoInstance" : type.text, type);
    setContainerField(element, field);
    if (isInstance)
      set(element, "name", type.text);
    if (!name.empty())
      set(element, "DEF", elements_.define(name, element.name()));
    tokens_.take(TokenKind::openNode, "{");
    while (!tokens_.nextIs(TokenKind::closeNode))
      readBodyStatement(element, prototype);
    addComments(element);
    tokens_.take();
    --depth_;
  }

  void readBodyStatement(pugi::xml_node element, pugi::xml_node prototype) {
    const bool isStatement = tokens_.nextIs("ROUTE") || tokens_.nextIs("PROTO") || tokens_.nextIs("EXTERNPROTO");
    if (isStatement)
      return readStatement(element, "");
    const Token token = tokens_.take(TokenKind::word, "a field or }");
    if (!accessTypeOf(token.text).empty() && isFieldType(tokens_.next())) // of a script, a shader, or an unknown node
      return readDeclaration(element, token, true);
    if (prototype)
      return readFieldOfInstance(element, token, prototype);
    elements_.requireName(token, token.text);
    const std::string field(currentFieldName(element.name(), token.text));
    if (tokens_.nextIs("IS"))
      return readConnection(element, field, token);
    readValue({element, field, field, isStringList(element.name(), field), isNodeList(field)});
  }

  void readFieldOfInstance(pugi::xml_node element, const Token& field, pugi::xml_node prototype) {
    if (tokens_.nextIs("IS"))
      return readConnection(element, std::string(field.text), field);
    const std::string name(field.text);
    const pugi::xml_node interface = prototype.child("ProtoInterface") ? prototype.child("ProtoInterface") : prototype;
    const std::string type = interface.find_child_by_attribute("field", "name", name.c_str()).attribute("type").value();
    pugi::xml_node value = elements_.add(element, "fieldValue", field);
    set(value, "name", name);
    readValue({value, "value", "", type == "MFString", isNodesType(type)});
  }

  /// Reads "field IS fieldOfPrototype", from IS on.
  void readConnection(pugi::xml_node element, const std::string& field, const Token& where) {
    tokens_.take();
    pugi::xml_node is = element.child("IS");
    if (!is)
      is = elements_.add(element, "IS", where);
    pugi::xml_node connect = elements_.add(is, "connect", where);
    set(connect, "nodeField", field);
    set(connect, "protoField", takeWord("a field of the prototype"));
  }

  /// Reads "accessType type name", from the type on, and a value where the field has one.
  void readDeclaration(pugi::xml_node parent, const Token& access, bool hasValues) {
    const std::string accessType(accessTypeOf(access.text)), type = takeWord("a type"), name = takeWord("a name");
    pugi::xml_node field = elements_.add(parent, "field", access);
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
    pugi::xml_node declaration = elements_.add(parent, "ProtoDeclare", token);
    set(declaration, "name", name);
    readDeclarations(elements_.add(declaration, "ProtoInterface", token), true);
    pugi::xml_node body = elements_.add(declaration, "ProtoBody", token);
    tokens_.take(TokenKind::openNode, "{");
    elements_.openScope();
    while (!tokens_.nextIs(TokenKind::closeNode))
      readStatement(body, "");
    tokens_.take();
    elements_.closeScope();
    elements_.declare(name, declaration);
    --depth_;
  }

  void readExternPrototype(pugi::xml_node parent, const Token& token) {
    const std::string name = takeWord("a name");
    pugi::xml_node declaration = elements_.add(parent, "ExternProtoDeclare", token);
    set(declaration, "name", name);
    readDeclarations(declaration, false);
    readValue({declaration, "url", "", true, false});
    elements_.declare(name, declaration);
  }

  /// Reads one number, string, boolean or node, or a list of them in brackets.
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
        text.append(text.empty() ? "" : " ").append(word == "TRUE" ? "true" : word == "FALSE" ? "false" : word);
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
  VrmlElements elements_;
  pugi::xml_node x3d_, head_, scene_;
  std::size_t depth_ = 0;
};

} // namespace

Elements parseVrml(std::string_view text, const std::string& name) {
  return VrmlParser(text, name).parse();
}

} // namespace imgeo::x3d
