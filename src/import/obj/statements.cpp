#include "import/obj/statements.h"

#include "base/error.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"
#include "import/warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo {

namespace {

constexpr std::size_t maxNamedKeywords = 8; // in the warning about skipped statements

} // namespace

void ObjStatements::read() {
  for (; !scanner_.atEnd(); scanner_.skipLine()) {
    scanner_.skipBlanks();
    readStatement(scanner_.word());
  }
  for (const Named* named : {&positions_, &texCoords_, &normals_})
    requireNamed(*named);
  for (const WaitingPolygon& polygon : waiting_)
    addPolygon(polygon.object, polygon.corners);
}

/// Requires that statements of all named indices have been read.
void ObjStatements::requireNamed(const Named& named) {
  if (named.highest <= static_cast<std::int64_t>(named.count))
    return;
  scanner_.goTo(named.highestAt);
  scanner_.fail(ErrorKind::malformed,
                fmt::format("{} {} is named, but there are only {}", named.what, named.highest, named.count));
}

void ObjStatements::readStatement(std::string_view keyword) {
  if (keyword.empty() || keyword.front() == '#')
    return;
  if (keyword == "v")
    readVertex();
  else if (keyword == "vt")
    readTexCoord();
  else if (keyword == "vn")
    readNormal();
  else if (keyword == "f")
    readFace();
  else if (keyword == "o")
    beginObject(std::string(scanner_.restOfLine()));
  else if (keyword == "l")
    readLineElement();
  else if (keyword == "p")
    ++pointStatements_;
  else if (keyword == "usemtl")
    useMaterial(std::string(scanner_.restOfLine()));
  else if (keyword == "mtllib")
    libraries_.emplace_back(scanner_.restOfLine());
  else if (keyword != "g" && keyword != "s" && skippedKeywords_.size() < maxNamedKeywords)
    skippedKeywords_.insert(asPrintable(keyword));
}

void ObjStatements::beginObject(std::string name) {
  const ObjObject& last = objects_.back();
  objects_.push_back({std::move(name), last.material, last.index + 1, {}, {}});
  current_ = objects_.size() - 1;
  subsets_ = {{objects_[current_].material, current_}};
}

/// All elements of an object that have the same material form one subset.
void ObjStatements::useMaterial(std::string name) {
  if (objects_[current_].material == name)
    return;
  const auto [subset, isNew] = subsets_.try_emplace(name, objects_.size());
  if (isNew) {
    const ObjObject& object = objects_[current_];
    objects_.push_back({object.name, std::move(name), object.index, {}, {}});
  }
  current_ = subset->second;
}

/// Reads the numbers up to the end of the line, at most as many as fit into `out`.
std::size_t ObjStatements::readNumbers(std::span<float> out, std::size_t minCount) {
  std::size_t count = 0;
  for (scanner_.skipBlanks(); count < out.size(); scanner_.skipBlanks()) {
    if (count >= minCount && scanner_.atLineEnd())
      break;
    out[count++] = scanner_.float32("a number");
  }
  return count;
}

void ObjStatements::checkFinite(std::span<const float> values, const char* what) const {
  if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
    scanner_.fail(ErrorKind::malformed, fmt::format("{} is not a number or beyond single precision", what));
}

/// "v x y z", "v x y z w" or "v x y z r g b"; an alpha after b is ignored.
void ObjStatements::readVertex() {
  Vec3d exact;
  for (int axis = 0; axis < 3; ++axis) {
    scanner_.skipBlanks();
    exact[axis] = scanner_.float64("a number");
  }
  const Vec3f position = rounded_.round(exact);
  checkFinite(std::array{position.x, position.y, position.z}, "a coordinate");
  std::array<float, 4> n{};
  const bool hasColor = readNumbers(n, 0) >= 3;
  hasColors_ |= hasColor;
  const Rgba color = hasColor ? Rgba(channel(n[0]), channel(n[1]), channel(n[2]), 1.0f) : Rgba(1, 1, 1, 1);
  sink_.addVertex(position, hasColors_ ? &color : nullptr);
  ++positions_.count;
}

float ObjStatements::channel(float value) {
  if (!(value >= 0 && value * 255 < 255.5f)) // beyond rounding
    ++colorsClamped_;
  return channelOf(value);
}

void ObjStatements::readTexCoord() {
  std::array<float, 3> n{};
  readNumbers(n, 1);
  checkFinite(n, "a texture coordinate");
  sink_.addTexCoord({n[0], n[1]});
  ++texCoords_.count;
}

void ObjStatements::readNormal() {
  std::array<float, 3> n{};
  readNumbers(n, 3);
  Vec3f normal{n[0], n[1], n[2]};
  unusableNormals_ += !makeUnit(normal);
  sink_.addNormal(normal);
  ++normals_.count;
}

/// Reads an index, which counts from 1, also on to statements further down, or backwards from this line where negative.
std::uint32_t ObjStatements::readIndex(Named& named) {
  const std::int64_t number = scanner_.integer("an index");
  const std::int64_t all = static_cast<std::int64_t>(named.count);
  if (number == 0 || number < -all)
    scanner_.fail(ErrorKind::malformed,
                  fmt::format("{} {} is named, but {} stand before this line", named.what, number, all));
  if (number > std::max(all, named.highest)) {
    named.highest = number;
    named.highestAt = scanner_.byteOffset();
  }
  // A number that 32 bits do not hold is refused at the end of the file.
  return static_cast<std::uint32_t>(number > 0 ? std::min<std::int64_t>(number, ObjCorner::none) - 1 : all + number);
}

/// "v", "v/vt", "v//vn" or "v/vt/vn"; some programs write slashes before what is missing at the end, too.
ObjCorner ObjStatements::readCorner() {
  ObjCorner corner;
  corner.position = readIndex(positions_);
  if (scanner_.skipChar('/')) {
    bool hasSecond = scanner_.skipChar('/');
    if (!hasSecond && !scanner_.atWordEnd()) {
      corner.texCoord = readIndex(texCoords_);
      hasSecond = scanner_.skipChar('/');
    }
    if (hasSecond && !scanner_.atWordEnd())
      corner.normal = readIndex(normals_);
  }
  if (!scanner_.atWordEnd())
    scanner_.fail(ErrorKind::malformed, "a corner has the form v, v/vt, v//vn or v/vt/vn");
  return corner;
}

/// Reads the corners of a polygon or polyline: the rest of the statement.
void ObjStatements::readCorners() {
  polygon_.clear();
  for (scanner_.skipBlanks(); !scanner_.atLineEnd(); scanner_.skipBlanks())
    polygon_.push_back(readCorner());
}

void ObjStatements::readLineElement() {
  readCorners();
  linesTooShort_ += polygon_.size() < 2;
  for (std::size_t i = 1; i < polygon_.size(); ++i)
    sink_.addLine(objects_[current_], {polygon_[i - 1], polygon_[i]});
}

void ObjStatements::readFace() {
  readCorners();
  const auto isFurtherDown = [&](const ObjCorner& corner) { return corner.position >= positions_.count; };
  if (polygon_.size() < 3) {
    ++facesTooSmall_;
  } else if (polygon_.size() == 3) {
    sink_.addTriangle(objects_[current_], {polygon_[0], polygon_[1], polygon_[2]});
  } else if (std::ranges::any_of(polygon_, isFurtherDown)) {
    sink_.expectVertices();
    waiting_.push_back({current_, polygon_});
  } else {
    addPolygon(current_, polygon_);
  }
}

/// Divides a polygon of which all vertices have been read.
void ObjStatements::addPolygon(std::size_t object, const std::vector<ObjCorner>& polygon) {
  ring_.clear(), ringTriangles_.clear();
  for (const ObjCorner& corner : polygon)
    ring_.push_back(sink_.positionOf(corner.position));
  fans_ += !triangulate(ring_, ringTriangles_);
  for (std::size_t i = 0; i < ringTriangles_.size(); i += 3)
    sink_.addTriangle(objects_[object],
                      {polygon[ringTriangles_[i]], polygon[ringTriangles_[i + 1]], polygon[ringTriangles_[i + 2]]});
}

void ObjStatements::addWarnings(std::vector<std::string>& warnings, bool hasElements) const {
  if (linesTooShort_ > 0)
    warnings.push_back(
        fmt::format("{} left out: fewer than two corners.", counted(linesTooShort_, "line was", "lines were")));
  if (pointStatements_ > 0 && hasElements)
    warnings.push_back(fmt::format("Points of the OBJ file, which has faces or lines, are not carried over ({}).",
                                   counted(pointStatements_, "statement", "statements")));
  if (!skippedKeywords_.empty())
    warnings.push_back(
        fmt::format("Statements of the OBJ file that imgeo does not read: {}.", fmt::join(skippedKeywords_, ", ")));
  rounded_.addWarning(warnings);
  warnOfColors(warnings, colorsClamped_);
  warnOfNormals(warnings, unusableNormals_);
  warnOfSmallFaces(warnings, facesTooSmall_);
  warnOfFans(warnings, fans_);
}

} // namespace imgeo
