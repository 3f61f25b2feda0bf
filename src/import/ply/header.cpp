#include "import/ply/header.h"

#include "import/text/line_ends.h"
#include "import/text/text_scanner.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <unordered_set>

namespace imgeo {

namespace {

struct TypeName {
  const char *name, *sizedName;
  PlyType type;
  std::size_t bytes;
};

constexpr std::array<TypeName, 8> plyTypes{{{"char", "int8", PlyType::int8, 1},
                                            {"uchar", "uint8", PlyType::uint8, 1},
                                            {"short", "int16", PlyType::int16, 2},
                                            {"ushort", "uint16", PlyType::uint16, 2},
                                            {"int", "int32", PlyType::int32, 4},
                                            {"uint", "uint32", PlyType::uint32, 4},
                                            {"float", "float32", PlyType::float32, 4},
                                            {"double", "float64", PlyType::float64, 8}}};

std::string nextWord(TextScanner& line) {
  line.skipBlanks();
  return std::string(line.word());
}

PlyType typeNamed(const std::string& word, const TextScanner& line) {
  for (const TypeName& type : plyTypes)
    if (word == type.name || word == type.sizedName)
      return type.type;
  line.fail(ErrorKind::malformed, fmt::format("the header names an unknown type '{}'", asPrintable(word)));
}

PlyProperty readProperty(TextScanner& line) {
  PlyProperty property;
  std::string word = nextWord(line);
  if (word == "list") {
    property.countType = typeNamed(nextWord(line), line);
    if (!isInteger(*property.countType))
      line.fail(ErrorKind::malformed, "the header counts a list with a type that has fractions");
    word = nextWord(line);
  }
  property.type = typeNamed(word, line);
  property.name = nextWord(line);
  if (property.name.empty())
    line.fail(ErrorKind::malformed, "the header has a property without a name");
  return property;
}

PlyElement readElement(TextScanner& line) {
  PlyElement element;
  element.name = nextWord(line);
  line.skipBlanks();
  const std::int64_t count = line.integerWord("a number of elements");
  if (element.name.empty() || count < 0)
    line.fail(ErrorKind::malformed, "the header has an element without a name or with a negative count");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

/// The direction that a comment states, of which the line holds the rest; empty for another comment.
std::optional<AxisDirection> upOfComment(TextScanner line) {
  const std::string_view comment = line.restOfLine();
  for (const AxisDirection each : {AxisDirection::x, AxisDirection::y, AxisDirection::z, AxisDirection::minusX,
                                   AxisDirection::minusY, AxisDirection::minusZ})
    if (comment == fmt::format("up {}", nameOf(each)))
      return each;
  return {};
}

/// The image file that a comment names, of which the line holds the rest; empty for another comment.
std::string textureFileOf(TextScanner line) {
  constexpr std::string_view keyword = "TextureFile ";
  const std::string_view comment = line.restOfLine();
  return comment.starts_with(keyword) ? std::string(comment.substr(keyword.size())) : "";
}

PlyEncoding readEncoding(TextScanner& line) {
  const std::string word = nextWord(line), version = nextWord(line);
  if (version != "1.0")
    line.fail(ErrorKind::unsupported, fmt::format("this is PLY version '{}'; imgeo reads 1.0", asPrintable(version)));
  if (word == "ascii")
    return PlyEncoding::ascii;
  if (word == "binary_little_endian")
    return PlyEncoding::littleEndian;
  if (word == "binary_big_endian")
    return PlyEncoding::bigEndian;
  line.fail(ErrorKind::unsupported, fmt::format("the header names an unknown encoding '{}'", asPrintable(word)));
}

/// Adds the elements and properties of the header's lines, whose names it looks up in constant time.
class HeaderBuilder {
public:
  PlyHeader header;

  void addElement(TextScanner& line) {
    PlyElement element = readElement(line);
    if (header.elements.size() == maxPlyElements)
      line.fail(ErrorKind::limit, fmt::format("the header has more than {} elements", maxPlyElements));
    if (!elementNames_.insert(element.name).second)
      line.fail(ErrorKind::malformed, fmt::format("the header has two elements '{}'", asPrintable(element.name)));
    propertyNames_.clear();
    header.elements.push_back(std::move(element));
  }

  void addProperty(TextScanner& line) {
    PlyProperty property = readProperty(line);
    if (header.elements.empty())
      line.fail(ErrorKind::malformed, "the header has a property before any element");
    if (++propertyCount_ > maxPlyProperties)
      line.fail(ErrorKind::limit, fmt::format("the header has more than {} properties", maxPlyProperties));
    PlyElement& element = header.elements.back();
    if (!propertyNames_.insert(property.name).second)
      line.fail(ErrorKind::malformed, fmt::format("the header gives '{}' two properties '{}'",
                                                  asPrintable(element.name), asPrintable(property.name)));
    element.properties.push_back(std::move(property));
  }

  void addComment(const TextScanner& line) {
    if (const std::optional<AxisDirection> up = upOfComment(line))
      header.up = up;
    if (std::string file = textureFileOf(line); !file.empty()) {
      if (header.textureFiles.size() == maxPlyTextures)
        line.fail(ErrorKind::limit, fmt::format("the header names more than {} textures", maxPlyTextures));
      header.textureFiles.push_back(std::move(file));
    }
  }

private:
  std::unordered_set<std::string> elementNames_, propertyNames_; ///< of the header; of its last element
  std::size_t propertyCount_ = 0;
};

} // namespace

std::size_t byteSizeOf(PlyType type) {
  return plyTypes[static_cast<std::size_t>(type)].bytes;
}

const PlyProperty* PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  return found == properties.end() ? nullptr : &*found;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  const auto found = std::ranges::find(elements, element, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

namespace {

PlyHeader readLines(ByteSpan bytes, const std::string& name) {
  TextScanner scanner(bytes, name);
  if (nextWord(scanner) != "ply")
    scanner.fail(ErrorKind::malformed, "a PLY file begins with the line 'ply'");
  scanner.skipLine();

  HeaderBuilder builder;
  bool hasEncoding = false;
  for (;;) {
    const std::string keyword = nextWord(scanner);
    if (keyword == "comment")
      builder.addComment(scanner);
    if (keyword == "comment" || keyword == "obj_info" || (keyword.empty() && !scanner.atEnd())) {
      scanner.skipLine();
      continue;
    }
    if (keyword == "format") {
      builder.header.encoding = readEncoding(scanner);
      hasEncoding = true;
    } else if (keyword == "element") {
      builder.addElement(scanner);
    } else if (keyword == "property") {
      builder.addProperty(scanner);
    } else if (keyword != "end_header" && !scanner.atEnd()) {
      scanner.fail(ErrorKind::malformed, fmt::format("'{}' is no keyword of a PLY header", asPrintable(keyword)));
    }
    scanner.skipBlanks();
    if (scanner.atEnd())
      scanner.fail(ErrorKind::truncated, "the file ends within its header");
    if (!scanner.atLineEnd())
      scanner.fail(ErrorKind::malformed, "this line of the header has too many words");
    scanner.skipLine();
    if (keyword == "end_header")
      break;
  }
  if (!hasEncoding)
    scanner.fail(ErrorKind::malformed, "the header has no line 'format'");
  builder.header.bodyOffset = scanner.byteOffset();
  return std::move(builder.header);
}

/// A copy of the header alone, with line feeds for its carriage returns: elements of binary files are no text.
Bytes headerWithLineFeeds(ByteSpan bytes) {
  constexpr std::size_t maxHeaderBytes = std::size_t{16} << 20;
  constexpr std::string_view last = "\rend_header";
  const std::string_view text = asText(bytes).substr(0, maxHeaderBytes);
  const std::size_t found = text.find(last);
  const std::size_t end = found == text.npos ? text.npos : text.find('\r', found + last.size());
  return withoutCarriageReturns(bytes.first(end == text.npos ? text.size() : end + 1));
}

} // namespace

bool hasPlyCarriageReturns(std::string_view text) {
  return text.starts_with("ply\r") && !text.starts_with("ply\r\n");
}

PlyHeader readPlyHeader(ByteSpan bytes, const std::string& name) {
  if (!hasPlyCarriageReturns(asText(bytes)))
    return readLines(bytes, name);
  PlyHeader header = readLines(headerWithLineFeeds(bytes), name);
  header.hasCarriageReturns = true;
  return header;
}

} // namespace imgeo
