#pragma once
// The statements of an OBJ file ("Object Files", Advanced Visualizer manual, appendix B1), with the vertex colours that
// scanners append to their vertices.

#include "import/obj/object.h"
#include "import/text/rounded_positions.h"
#include "import/text/text_scanner.h"

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// Takes the content of an OBJ file in its order.
class ObjSink {
public:
  virtual ~ObjSink() = default;
  /// `position` is finite, and less the origin. `color`: nullptr until the first vertex that has one; from then on
  /// others are white.
  virtual void addVertex(const Vec3f& position, const Rgba* color) = 0;
  virtual void addTexCoord(const Vec2f& texCoord) = 0; ///< finite
  virtual void addNormal(const Vec3f& normal) = 0;     ///< of unit length
  /// A position that has been added.
  virtual Vec3f positionOf(std::uint32_t index) const = 0;
  /// Called before a polygon is kept in memory until the end of the file, since its vertices are further down.
  virtual void expectVertices() {}
  /// Indices of corners are those of vertices that have been added when ObjStatements::read() returns. `object`: valid
  /// during the call.
  virtual void addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) = 0;
  virtual void addLine(ObjObject& object, const std::array<ObjCorner, 2>& corners) = 0;
};

/// Reads an OBJ file, and counts what it leaves out.
class ObjStatements {
public:
  /// All must outlive the object.
  /// `origin`: see ImportOptions.
  ObjStatements(ByteSpan bytes, const std::string& name, const std::optional<Vec3d>& origin, ObjSink& sink)
      : scanner_(bytes, name), sink_(sink), rounded_(origin) {}

  /// Corners may name statements further down, as Assimp reads them. Safe for untrusted bytes. Throws Error{truncated,
  /// malformed} with the line, and what the sink throws.
  void read();

  /// The objects and their subsets, of which some have no elements.
  std::vector<ObjObject>& objects() { return objects_; }
  Vec3d origin() const { return rounded_.origin(); }                       ///< what has been subtracted from positions
  const std::vector<std::string>& libraries() const { return libraries_; } ///< files that mtllib statements name
  /// `hasElements`: whether the file has triangles or lines.
  void addWarnings(std::vector<std::string>& warnings, bool hasElements) const;

private:
  /// The statements of a kind that corners name.
  struct Named {
    const char* what;          ///< in errors
    std::size_t count = 0;     ///< that have been read
    std::int64_t highest = 0;  ///< that a corner has named before it was read; counts from 1
    std::size_t highestAt = 0; ///< the byte behind that corner's index
  };
  /// A polygon that names vertices further down.
  struct WaitingPolygon {
    std::size_t object; ///< its subset
    std::vector<ObjCorner> corners;
  };

  void readStatement(std::string_view keyword);
  void beginObject(std::string name);
  void useMaterial(std::string name);
  std::size_t readNumbers(std::span<float> out, std::size_t minCount);
  void checkFinite(std::span<const float> values, const char* what) const;
  void readVertex();
  float channel(float value);
  void readTexCoord();
  void readNormal();
  std::uint32_t readIndex(Named& named);
  ObjCorner readCorner();
  void readCorners();
  void readLineElement();
  void readFace();
  void addPolygon(std::size_t object, const std::vector<ObjCorner>& polygon);
  void requireNamed(const Named& named);

  TextScanner scanner_;
  ObjSink& sink_;
  std::vector<ObjObject> objects_{ObjObject{}}; ///< statements before the first "o" form an object without a name
  Named positions_{"vertex"}, texCoords_{"texture coordinate"}, normals_{"normal"};
  std::vector<WaitingPolygon> waiting_;
  bool hasColors_ = false; ///< whether a vertex has had one
  RoundedPositions rounded_;
  std::vector<ObjCorner> polygon_;                      ///< the corners of the current face or polyline
  std::vector<Vec3f> ring_;                             ///< the positions of polygon_
  std::vector<std::uint32_t> ringTriangles_;            ///< its triangles, as indices into polygon_
  std::size_t current_ = 0;                             ///< the subset that elements are added to
  std::map<std::string, std::size_t> subsets_{{"", 0}}; ///< subsets of the current object by material
  std::vector<std::string> libraries_;
  std::size_t linesTooShort_ = 0, pointStatements_ = 0, facesTooSmall_ = 0, fans_ = 0, colorsClamped_ = 0,
              unusableNormals_ = 0;
  std::set<std::string> skippedKeywords_; ///< at most maxNamedKeywords of them
};

} // namespace imgeo
