#pragma once
// PTS point clouds (Leica Cyclone): for each scan a line with the number of its points, then a line for each point: x y
// z, perhaps its intensity, perhaps red, green and blue of 0 .. 255. Each scan is a shape. Coordinates far from zero
// are stored around an origin, which the document's metadata state (MetadataSet "georeference").

#include "import/import.h"
#include "import/text/text_scanner.h"

#include <array>
#include <optional>
#include <string_view>

namespace imgeo {

inline constexpr std::array<std::string_view, 1> ptsExtensions{".pts"};

Imported readPts(ByteSpan bytes, const std::string& name, const ImportOptions& options);

/// The same for a part of a file, whose coordinates are stored around the origin of the whole (originOf()).
Imported readPtsAround(const Vec3d& origin, ByteSpan bytes, const std::string& name, const ImportOptions& options);

/// Reads the numbers of points of scans and the points' lines.
class PtsScanner {
public:
  /// `text` and `name` must outlive it.
  PtsScanner(ByteSpan text, const std::string& name) : scanner_(text, name) {}

  /// Whether a scan follows.
  bool hasScan();
  /// The number of points of a scan. Throws Error (truncated, malformed, limit) where the file cannot hold them.
  std::uint64_t pointCount();
  /// The byte of the next line, of a point.
  std::size_t beginOfPoint();
  std::size_t byteOffset() const { return scanner_.byteOffset(); }

  struct Point {
    Vec3d position; ///< finite, within single precision
    double numbers[4] = {};
    std::size_t numberCount = 0; ///< of the line: 3, 4 (with intensity), 6 (with red, green, blue), 7 (with all four)
    bool hasIntensity() const { return numberCount % 3 == 1; }
    bool hasColor() const { return numberCount >= 6; }
    const double* color() const { return numbers + (hasIntensity() ? 1 : 0); }
  };
  /// Reads the next point, number `number` of `count`. All points of a scan have as many numbers.
  Point point(std::uint64_t number, std::uint64_t count);

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { scanner_.fail(kind, message); }

private:
  TextScanner scanner_;
  std::size_t columns_ = 0; ///< of the scan's points; 0: not known yet
  std::uint64_t total_ = 0; ///< points of all scans
};

} // namespace imgeo
