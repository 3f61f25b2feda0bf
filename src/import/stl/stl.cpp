// STL (3D Systems, "StereoLithography Interface Specification", 1989). Binary files may begin with "solid" too, so the
// file's size is checked first.
#include "import/stl/stl.h"
#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/far_origin.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/text/rounded_positions.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace imgeo {

namespace {

constexpr std::size_t headerBytes = 80, prefixBytes = 84, facetBytes = 50;
constexpr std::size_t facetNormalBytes = 12, facetAttributeOffset = 48;
/// The bytes in which a zero byte shows that a file is binary: the facet count of fewer than 2^24 facets has one, ASCII
/// files have none.
constexpr std::size_t sniffedBytes = 512;

bool equalsIgnoringCase(std::string_view a, std::string_view lower) {
  return std::ranges::equal(a, lower, [](unsigned char x, unsigned char y) { return std::tolower(x) == y; });
}

std::uint64_t facetCount(ByteSpan bytes) {
  return loadLittle<std::uint32_t>(&bytes[headerBytes]);
}

bool hasBinarySize(ByteSpan bytes) {
  return bytes.size() >= prefixBytes && bytes.size() == prefixBytes + facetBytes * facetCount(bytes);
}

bool isAscii(ByteSpan bytes) {
  const std::string_view text = asText(bytes);
  const std::size_t from = text.find_first_not_of(" \t\r\n");
  return from != text.npos && equalsIgnoringCase(text.substr(from, 5), "solid") &&
         text.substr(0, sniffedBytes).find('\0') == text.npos;
}

/// Adds a corner with a position of its own, since STL files have no connectivity.
void addCorner(Mesh& mesh, Vec3f position) {
  const auto corner = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(position);
  mesh.wedgePositions.push_back(corner);
  mesh.corners.push_back(corner);
}

bool isFinite(Vec3f p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

constexpr const char* notFinite = "a coordinate is not a number or beyond single precision";

Imported readBinary(ByteSpan bytes, const std::string& name, const Vec3d& origin) {
  if (bytes.size() < prefixBytes)
    throw Error(ErrorKind::truncated, name, "the file is too short for an STL file's header");
  const std::uint64_t count = facetCount(bytes);
  if (count > (bytes.size() - prefixBytes) / facetBytes)
    throw Error(ErrorKind::truncated, byteLocation(name, headerBytes),
                fmt::format("the header promises {} facets of 50 bytes, but only {} bytes follow", count,
                            bytes.size() - prefixBytes));
  if (count > std::numeric_limits<std::uint32_t>::max() / 3)
    throw Error(ErrorKind::limit, name, "more corners than 32-bit indices can name");

  Mesh mesh;
  mesh.name = stemOf(name);
  mesh.positions.reserve(3 * count), mesh.wedgePositions.reserve(3 * count), mesh.corners.reserve(3 * count);
  bool hasAttributes = false;
  for (std::uint64_t facet = 0; facet < count; ++facet) {
    const std::uint8_t* at = &bytes[prefixBytes + facetBytes * facet];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t* from = at + facetNormalBytes + 12 * k;
      const Vec3f p{loadLittle<float>(from), loadLittle<float>(from + 4), loadLittle<float>(from + 8)};
      if (!isFinite(p))
        throw Error(ErrorKind::malformed, byteLocation(name, static_cast<std::size_t>(from - bytes.data())), notFinite);
      addCorner(mesh, Vec3f(Vec3d(p) - origin));
    }
    hasAttributes |= loadLittle<std::uint16_t>(at + facetAttributeOffset) != 0;
  }
  Imported imported;
  if (hasAttributes)
    imported.warnings.emplace_back("Facet colours of the STL file (its attribute bytes) are not carried over.");
  if (const std::size_t rest = bytes.size() - prefixBytes - facetBytes * count; rest > 0)
    imported.warnings.push_back(fmt::format("{} behind the last facet of the STL file, which imgeo ignored.",
                                            counted(rest, "byte stands", "bytes stand")));
  addShape(imported.scene, std::move(mesh), "");
  setOrigin(imported, origin);
  return imported;
}

/// Reads the coordinates after the word "vertex".
Vec3f readVertex(TextScanner& scanner, RoundedPositions& rounded) {
  Vec3d exact;
  for (int axis = 0; axis < 3; ++axis) {
    scanner.skipSpace();
    exact[axis] = scanner.float64("a coordinate");
  }
  const Vec3f p = rounded.round(exact);
  if (!isFinite(p))
    scanner.fail(ErrorKind::malformed, notFinite);
  return p;
}

/// Reads facets up to and including the line "endsolid".
void readSolid(TextScanner& scanner, Mesh& mesh, RoundedPositions& rounded) {
  for (;;) {
    scanner.skipSpace();
    if (scanner.atEnd())
      scanner.fail(ErrorKind::truncated, "the file ends before 'endsolid'");
    const std::string_view word = scanner.word();
    if (equalsIgnoringCase(word, "vertex")) {
      addCorner(mesh, readVertex(scanner, rounded));
    } else if (equalsIgnoringCase(word, "endloop")) {
      if (mesh.corners.size() % 3 != 0)
        scanner.fail(ErrorKind::malformed, "a facet has other than three corners");
    } else if (equalsIgnoringCase(word, "facet") || equalsIgnoringCase(word, "outer")) {
      if (mesh.corners.size() % 3 != 0)
        scanner.fail(ErrorKind::malformed, "a facet begins within another");
      scanner.skipLine(); // the facet normal, or "loop"
    } else if (equalsIgnoringCase(word, "endsolid")) {
      if (mesh.corners.size() % 3 != 0)
        scanner.fail(ErrorKind::malformed, "the solid ends within a facet");
      scanner.skipLine();
      return;
    } else if (!equalsIgnoringCase(word, "endfacet")) {
      scanner.fail(ErrorKind::malformed, fmt::format("'{}' is no keyword of an STL file", asPrintable(word)));
    }
  }
}

Imported readAscii(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  Imported imported;
  RoundedPositions rounded(options.origin);
  TextScanner scanner(bytes, name);
  for (;;) {
    scanner.skipSpace();
    if (scanner.atEnd())
      break;
    if (!equalsIgnoringCase(scanner.word(), "solid"))
      scanner.fail(ErrorKind::malformed, "the word 'solid' expected");
    const std::string solid(scanner.restOfLine());
    Mesh mesh;
    mesh.name = solid.empty() ? stemOf(name) : solid;
    readSolid(scanner, mesh, rounded);
    if (!mesh.corners.empty())
      addShape(imported.scene, std::move(mesh), solid);
  }
  setOrigin(imported, rounded.origin());
  rounded.addWarning(imported.warnings);
  return imported;
}

} // namespace

bool isStl(ByteSpan bytes) {
  return hasBinarySize(bytes) || isAscii(bytes);
}

Imported readStl(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const bool isText = !hasBinarySize(bytes) && isAscii(bytes);
  const std::optional<Bytes> text = isText ? withLineFeeds(bytes) : std::nullopt;
  Imported imported = isText ? readAscii(text ? ByteSpan(*text) : bytes, name, options)
                             : readBinary(bytes, name, options.origin.value_or(Vec3d{0, 0, 0}));
  for (Mesh& mesh : imported.scene.meshes)
    mesh.creaseDegrees.reset(); // scans and machine parts
  imported.format = "STL";
  return imported;
}

} // namespace imgeo
