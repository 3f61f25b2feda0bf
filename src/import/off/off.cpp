#include "import/off/off.h"

#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/far_origin.h"
#include "import/mesh/point_cloud.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/text/number_lines.h"
#include "import/text/rounded_positions.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// The most numbers of a line: corners of a polygon, their number and its colour.
constexpr std::size_t maxNumbers = std::size_t{1} << 20;
/// The shortest lines of a vertex, "0 0 0", and of a polygon, "0".
constexpr std::size_t minVertexBytes = 6, minFaceBytes = 2;

/// The word with which files begin: [ST][C][N][4][n]OFF.
struct Keyword {
  std::size_t length = 0; ///< 0: there is none
  bool hasTexCoords = false, hasColors = false, hasNormals = false, hasOtherDimensions = false;
};

Keyword keywordOf(std::string_view line) {
  Keyword keyword;
  std::string_view rest = line;
  const auto takes = [&](std::string_view prefix) {
    const bool found = rest.starts_with(prefix);
    rest.remove_prefix(found ? prefix.size() : 0);
    return found;
  };
  keyword.hasTexCoords = takes("ST");
  keyword.hasColors = takes("C");
  keyword.hasNormals = takes("N");
  keyword.hasOtherDimensions = takes("4");
  keyword.hasOtherDimensions |= takes("n");
  if (!takes("OFF") || (!rest.empty() && std::string_view(" \t0123456789").find(rest.front()) == rest.npos))
    return {};
  keyword.length = line.size() - rest.size();
  return keyword;
}

/// Where the numbers of a vertex are in its line.
struct VertexColumns {
  std::size_t count = 0;
  std::size_t normal = 0, color = 0, texCoord = 0; ///< of the first number; 0: there are none
  std::size_t channels = 0;                        ///< of a colour: 3 or 4
};

class OffReader {
public:
  OffReader(ByteSpan text, const std::string& name, const ImportOptions& options)
      : name_(name), lines_(text, name, maxNumbers), bytes_(text.size()), rounded_(options.origin) {}

  Imported read() {
    readHeader();
    for (std::uint64_t number = 0; number < vertexCount_; ++number)
      readVertex(number);
    addColors();
    for (std::uint64_t number = 0; number < faceCount_; ++number)
      readFace(number);
    if (lines_.next())
      imported_.warnings.emplace_back("Lines behind the last polygon of the OFF file are ignored.");
    return imported();
  }

private:
  void readHeader() {
    if (!lines_.next())
      throw Error(ErrorKind::truncated, name_, "has no vertices");
    keyword_ = keywordOf(lines_.text());
    const std::string_view rest = lines_.text().substr(keyword_.length);
    const std::vector<std::string_view> words = wordsOf(rest);
    if (keyword_.hasOtherDimensions || (!words.empty() && words.front() == "BINARY"))
      lines_.fail("is OFF of another number of dimensions or binary, which imgeo does not read",
                  ErrorKind::unsupported);
    if (words.empty() && !lines_.next())
      throw Error(ErrorKind::truncated, name_, "has no vertices");
    const std::vector<std::string_view> counts = words.empty() ? wordsOf(lines_.text()) : words;
    if (counts.size() < 2 || counts.size() > 3) // that of edges, which nobody uses, may be missing
      lines_.fail("the numbers of vertices, polygons and edges expected");
    vertexCount_ = count(counts[0], minVertexBytes, "vertices");
    faceCount_ = count(counts[1], minFaceBytes, "polygons");
    mesh_.positions.reserve(vertexCount_);
  }

  std::uint64_t count(std::string_view word, std::size_t minBytes, const char* what) const {
    const std::optional<double> number = doubleIn(word);
    if (!number || !(*number >= 0) || *number != std::floor(*number))
      lines_.fail(fmt::format("the number of {} expected, not '{}'", what, asPrintable(word)));
    const std::size_t bytesLeft = bytes_ - lines_.end();
    const std::size_t possible = (bytesLeft + 1) / minBytes;
    if (*number > static_cast<double>(possible))
      lines_.fail(fmt::format("{:.0f} {} are promised, but only {} bytes follow", *number, what, bytesLeft),
                  ErrorKind::truncated);
    if (*number > std::numeric_limits<std::uint32_t>::max())
      lines_.fail(fmt::format("more {} than 32-bit indices can name", what), ErrorKind::limit);
    return static_cast<std::uint64_t>(*number);
  }

  std::span<const double> nextLine(std::uint64_t number, std::uint64_t count, const char* what) {
    if (!lines_.next())
      throw Error(ErrorKind::truncated, name_, fmt::format("ends after {} of {} {}", number, count, what));
    const std::span<const double> numbers = lines_.numbers();
    if (numbers.empty())
      lines_.fail(fmt::format("a line of {} without numbers", what));
    return numbers;
  }

  VertexColumns columnsOf(std::size_t count) const {
    VertexColumns columns;
    columns.count = count;
    std::size_t at = 3;
    if (keyword_.hasNormals)
      columns.normal = std::exchange(at, at + 3);
    const std::size_t texCoords = keyword_.hasTexCoords ? 2 : 0;
    const std::size_t channels = count - std::min(count, at + texCoords);
    if (channels > 0)
      columns.color = std::exchange(at, at + channels);
    if (texCoords > 0)
      columns.texCoord = at;
    columns.channels = channels;
    if (at + texCoords != count || (channels != 3 && channels != 4 && (channels != 0 || keyword_.hasColors)))
      lines_.fail(fmt::format("a vertex has {} numbers, which do not fit the keyword {}OFF", count, prefix()));
    return columns;
  }

  std::string prefix() const {
    return fmt::format("{}{}{}", keyword_.hasTexCoords ? "ST" : "", keyword_.hasColors ? "C" : "",
                       keyword_.hasNormals ? "N" : "");
  }

  void readVertex(std::uint64_t number) {
    const std::span<const double> numbers = nextLine(number, vertexCount_, "vertices");
    if (number == 0)
      columns_ = columnsOf(numbers.size());
    if (numbers.size() != columns_.count)
      lines_.fail(fmt::format("a vertex has {} numbers, and those before have {}", numbers.size(), columns_.count));
    const Vec3f position = rounded_.round({numbers[0], numbers[1], numbers[2]});
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
      lines_.fail("a coordinate is not a number or beyond single precision");
    mesh_.positions.push_back(position);
    if (columns_.normal > 0) {
      const double* const at = &numbers[columns_.normal];
      unusableNormals_ += !makeUnit(mesh_.normals.emplace_back(Vec3d{at[0], at[1], at[2]}));
    }
    if (columns_.texCoord > 0)
      mesh_.texCoords.emplace_back(texCoordOf(numbers[columns_.texCoord]), texCoordOf(numbers[columns_.texCoord + 1]));
    if (columns_.color > 0)
      channels_.insert(channels_.end(), &numbers[columns_.color], &numbers[columns_.color] + columns_.channels);
  }

  float texCoordOf(double number) const {
    if (!(std::abs(number) <= std::numeric_limits<float>::max()))
      lines_.fail("a texture coordinate is not a number or beyond single precision");
    return static_cast<float>(number);
  }

  /// Channels are fractions, or up to 255 where one of them is above 1.
  void addColors() {
    if (channels_.empty())
      return;
    const double white = *std::ranges::max_element(channels_) > 1 ? 255 : 1;
    for (std::size_t at = 0; at < channels_.size(); at += columns_.channels) {
      Rgba& color =
          mesh_.colors.emplace_back(pointColor(std::span(channels_).subspan(at).first<3>(), white, clampedColors_));
      if (columns_.channels == 4)
        color.a = channelOf(channels_[at + 3] / white);
    }
  }

  void readFace(std::uint64_t number) {
    const std::span<const double> numbers = nextLine(number, faceCount_, "polygons");
    const double size = numbers[0];
    if (!(size >= 0) || size != std::floor(size) || size > static_cast<double>(numbers.size() - 1))
      lines_.fail(fmt::format("a polygon of {} corners has {} numbers behind that", size, numbers.size() - 1));
    const std::span<const double> corners = numbers.subspan(1, static_cast<std::size_t>(size));
    hasFaceColors_ |= numbers.size() > corners.size() + 1;
    for (const double corner : corners)
      if (!(corner >= 0) || corner != std::floor(corner) || corner >= static_cast<double>(vertexCount_))
        lines_.fail(fmt::format("a polygon names vertex {}, but there are only {}", corner, vertexCount_));
    if (corners.size() < 3) {
      ++smallFaces_;
      return;
    }
    ring_.clear(), triangles_.clear();
    for (const double corner : corners)
      ring_.push_back(mesh_.positions[static_cast<std::size_t>(corner)]);
    fans_ += !triangulate(ring_, triangles_);
    for (const std::uint32_t corner : triangles_)
      mesh_.corners.push_back(static_cast<std::uint32_t>(corners[corner]));
    if (mesh_.corners.size() > std::numeric_limits<std::uint32_t>::max())
      lines_.fail("the polygons have more corners than 32-bit indices can name", ErrorKind::limit);
  }

  Imported imported() {
    if (faceCount_ == 0 && vertexCount_ == 0)
      throw Error(ErrorKind::malformed, name_, "has no vertices");
    mesh_.name = stemOf(name_);
    mesh_.wedgePositions.resize(mesh_.positions.size());
    std::iota(mesh_.wedgePositions.begin(), mesh_.wedgePositions.end(), 0u);
    if (faceCount_ == 0) {
      mesh_.topology = Topology::points;
      mesh_.corners = mesh_.wedgePositions;
    }
    mesh_.creaseDegrees.reset();
    addShape(imported_.scene, std::move(mesh_), "");
    setOrigin(imported_, rounded_.origin());
    if (hasFaceColors_)
      imported_.warnings.emplace_back("Colours of polygons of the OFF file are not carried over.");
    warnOfColors(imported_.warnings, clampedColors_);
    warnOfSmallFaces(imported_.warnings, smallFaces_);
    warnOfNormals(imported_.warnings, unusableNormals_);
    warnOfFans(imported_.warnings, fans_);
    rounded_.addWarning(imported_.warnings);
    imported_.format = "OFF";
    return std::move(imported_);
  }

  const std::string& name_;
  NumberLines lines_;
  std::size_t bytes_; ///< of the text
  RoundedPositions rounded_;
  Keyword keyword_;
  std::uint64_t vertexCount_ = 0, faceCount_ = 0;
  VertexColumns columns_;
  Mesh mesh_;
  std::vector<double> channels_; ///< of the colours
  std::vector<Vec3f> ring_;
  std::vector<std::uint32_t> triangles_;
  bool hasFaceColors_ = false;
  std::uint64_t clampedColors_ = 0, smallFaces_ = 0, unusableNormals_ = 0, fans_ = 0;
  Imported imported_;
};

} // namespace

bool isOff(ByteSpan bytes) {
  const std::string name;
  NumberLines lines(bytes, name, 0);
  return lines.next() && keywordOf(lines.text()).length > 0;
}

Imported readOff(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const std::optional<Bytes> text = withLineFeeds(bytes);
  return OffReader(text ? ByteSpan(*text) : bytes, name, options).read();
}

} // namespace imgeo
