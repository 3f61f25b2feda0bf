// Wavefront OBJ ("Object Files", Advanced Visualizer manual, appendix B1), with the vertex colours that scanners append
// to their vertices.
#include "import/obj/obj.h"
#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/triangulate.h"
#include "import/mesh/unit_normal.h"
#include "import/obj/materials.h"
#include "import/obj/object.h"
#include "import/source_name.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace imgeo {

namespace {

/// Bounds corners and vertices to 32 bits, since each takes at least two bytes.
constexpr std::uint64_t maxObjBytes = std::uint64_t{8} << 30;
constexpr std::size_t maxNamedKeywords = 8; // in the warning about skipped statements

class ObjReader {
public:
  ObjReader(ByteSpan bytes, const std::string& name, const References& references, bool isStrict)
      : scanner_(bytes, name), fileName_(name), references_(references), isStrict_(isStrict) {}

  Imported read() {
    for (; !scanner_.atEnd(); scanner_.skipLine()) {
      scanner_.skipBlanks();
      readStatement(scanner_.word());
    }
    std::erase_if(content_.objects,
                  [](const ObjObject& object) { return object.triangles.empty() && object.lines.empty(); });
    Imported imported;
    imported.format = "OBJ";
    if (content_.objects.empty())
      addPoints(imported.scene);
    else
      addObjects(imported);
    addWarnings(imported.warnings);
    return imported;
  }

private:
  void readStatement(std::string_view keyword) {
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

  void beginObject(std::string name) {
    const ObjObject& last = content_.objects.back();
    content_.objects.push_back({std::move(name), last.material, last.index + 1, {}, {}});
    current_ = content_.objects.size() - 1;
    subsets_ = {{content_.objects[current_].material, current_}};
  }

  /// All elements of an object that have the same material form one subset.
  void useMaterial(std::string name) {
    if (content_.objects[current_].material == name)
      return;
    const auto [subset, isNew] = subsets_.try_emplace(name, content_.objects.size());
    if (isNew) {
      const ObjObject& object = content_.objects[current_];
      content_.objects.push_back({object.name, std::move(name), object.index, {}, {}});
    }
    current_ = subset->second;
  }

  /// Reads the numbers up to the end of the line, at most as many as fit into `out`.
  std::size_t readNumbers(std::span<float> out, std::size_t minCount) {
    std::size_t count = 0;
    for (scanner_.skipBlanks(); count < out.size(); scanner_.skipBlanks()) {
      if (count >= minCount && scanner_.atLineEnd())
        break;
      out[count++] = scanner_.float32("a number");
    }
    return count;
  }

  void checkFinite(std::span<const float> values, const char* what) const {
    if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
      scanner_.fail(ErrorKind::malformed, fmt::format("{} is not a number or beyond single precision", what));
  }

  /// "v x y z", "v x y z w" or "v x y z r g b"; an alpha after b is ignored.
  void readVertex() {
    std::array<float, 7> n{};
    const std::size_t count = readNumbers(n, 3);
    checkFinite(std::span(n).first(3), "a coordinate");
    content_.positions.push_back({n[0], n[1], n[2]});
    constexpr Rgba white(1, 1, 1, 1);
    if (count >= 6) {
      content_.colors.resize(content_.positions.size() - 1, white); // for earlier vertices without colours
      content_.colors.emplace_back(channel(n[3]), channel(n[4]), channel(n[5]), 1.0f);
    } else if (!content_.colors.empty()) {
      content_.colors.push_back(white);
    }
  }

  float channel(float value) {
    if (!(value >= 0 && value * 255 < 255.5f)) // beyond rounding
      ++colorsClamped_;
    return channelOf(value);
  }

  void readTexCoord() {
    std::array<float, 3> n{};
    readNumbers(n, 1);
    checkFinite(n, "a texture coordinate");
    content_.texCoords.push_back({n[0], n[1]});
  }

  void readNormal() {
    std::array<float, 3> n{};
    readNumbers(n, 3);
    content_.normals.push_back({n[0], n[1], n[2]});
    unusableNormals_ += !makeUnit(content_.normals.back());
  }

  /// Reads an index, which counts from 1, or from the end where negative; it can refer to earlier statements only.
  std::uint32_t readIndex(std::size_t count, const char* what) {
    const std::int64_t number = scanner_.integer("an index");
    const std::int64_t all = static_cast<std::int64_t>(count);
    if (number == 0 || number > all || number < -all)
      scanner_.fail(ErrorKind::malformed,
                    fmt::format("{} {} is named, but {} stand before this line", what, number, count));
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : all + number);
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  ObjCorner readCorner() {
    ObjCorner corner;
    corner.position = readIndex(content_.positions.size(), "vertex");
    if (scanner_.skipChar('/')) {
      if (!scanner_.skipChar('/')) {
        corner.texCoord = readIndex(content_.texCoords.size(), "texture coordinate");
        if (scanner_.skipChar('/'))
          corner.normal = readIndex(content_.normals.size(), "normal");
      } else {
        corner.normal = readIndex(content_.normals.size(), "normal");
      }
    }
    if (!scanner_.atWordEnd())
      scanner_.fail(ErrorKind::malformed, "a corner has the form v, v/vt, v//vn or v/vt/vn");
    return corner;
  }

  /// Reads the corners of a polygon or polyline: the rest of the statement.
  void readCorners() {
    polygon_.clear();
    for (scanner_.skipBlanks(); !scanner_.atLineEnd(); scanner_.skipBlanks())
      polygon_.push_back(readCorner());
  }

  void readLineElement() {
    readCorners();
    linesTooShort_ += polygon_.size() < 2;
    for (std::size_t i = 1; i < polygon_.size(); ++i)
      content_.objects[current_].lines.insert(content_.objects[current_].lines.end(), {polygon_[i - 1], polygon_[i]});
  }

  void readFace() {
    readCorners();
    std::vector<ObjCorner>& object = content_.objects[current_].triangles;
    if (polygon_.size() < 3) {
      ++facesTooSmall_;
    } else if (polygon_.size() == 3) {
      object.insert(object.end(), polygon_.begin(), polygon_.end());
    } else {
      ring_.clear(), ringTriangles_.clear();
      for (const ObjCorner& corner : polygon_)
        ring_.push_back(content_.positions[corner.position]);
      fans_ += !triangulate(ring_, ringTriangles_);
      for (const std::uint32_t index : ringTriangles_)
        object.push_back(polygon_[index]);
    }
  }

  void addObjects(Imported& imported) {
    ObjMaterials materials(imported.scene.graph, references_);
    for (const std::string& library : libraries_)
      materials.readLibrary(library);
    ObjMeshBuilder builder(content_);
    // Makes the subsets of each object consecutive.
    std::ranges::stable_sort(content_.objects, {}, &ObjObject::index);
    for (auto first = content_.objects.begin(); first != content_.objects.end();) {
      const auto last = std::find_if(first, content_.objects.end(),
                                     [&](const ObjObject& object) { return object.index != first->index; });
      addObject(std::span(first, last), builder, materials, imported.scene);
      first = last;
    }
    if (builder.objectsWithPartialNormals > 0)
      imported.warnings.push_back(
          fmt::format("The normals of {} left out: some corners have none.",
                      counted(builder.objectsWithPartialNormals, "object were", "objects were")));
    addOmissions(imported.warnings, materials.omissions(), isStrict_, fileName_);
    materials.addWarnings(imported.warnings);
  }

  /// Adds an object; one of several subsets becomes a Group of shapes.
  void addObject(std::span<const ObjObject> subsets, ObjMeshBuilder& builder, ObjMaterials& materials, Scene& scene) {
    std::vector<std::size_t> shapes;
    for (const ObjObject& subset : subsets)
      for (const Topology topology : {Topology::triangles, Topology::lines}) {
        if ((topology == Topology::triangles ? subset.triangles : subset.lines).empty())
          continue;
        Mesh mesh = builder.build(subset, topology);
        if (mesh.name.empty())
          mesh.name = stemOf(fileName_);
        Shape shape;
        shape.mesh = scene.meshes.size();
        if (!subset.material.empty())
          shape.appearance = materials.appearance(subset.material);
        scene.meshes.push_back(std::move(mesh));
        shapes.push_back(addNode(scene.graph, {subsets.size() == 1 ? subset.name : "", shape, {}, ""}));
      }
    if (subsets.size() == 1)
      std::ranges::copy(shapes, std::back_inserter(scene.graph.roots));
    else
      addRoot(scene.graph, {subsets.front().name, Group{}, std::move(shapes), ""});
  }

  /// Adds the vertices of a file without faces and lines as a point cloud.
  void addPoints(Scene& scene) {
    Mesh mesh;
    mesh.name = stemOf(fileName_);
    mesh.topology = Topology::points;
    for (std::uint32_t i = 0; i < content_.positions.size(); ++i)
      mesh.corners.push_back(i);
    mesh.wedgePositions = mesh.corners;
    mesh.positions = std::move(content_.positions);
    mesh.colors = std::move(content_.colors);
    addShape(scene, std::move(mesh), "");
  }

  void addWarnings(std::vector<std::string>& warnings) const {
    if (linesTooShort_ > 0)
      warnings.push_back(
          fmt::format("{} left out: fewer than two corners.", counted(linesTooShort_, "line was", "lines were")));
    if (pointStatements_ > 0 && !content_.objects.empty())
      warnings.push_back(fmt::format("Points of the OBJ file, which has faces or lines, are not carried over ({}).",
                                     counted(pointStatements_, "statement", "statements")));
    if (!skippedKeywords_.empty())
      warnings.push_back(
          fmt::format("Statements of the OBJ file that imgeo does not read: {}.", fmt::join(skippedKeywords_, ", ")));
    warnOfColors(warnings, colorsClamped_);
    warnOfNormals(warnings, unusableNormals_);
    warnOfSmallFaces(warnings, facesTooSmall_);
    warnOfFans(warnings, fans_);
  }

  TextScanner scanner_;
  const std::string& fileName_;
  ObjContent content_{{}, {}, {}, {}, {ObjObject{}}}; ///< statements before the first "o" form an object without a name
  std::vector<ObjCorner> polygon_;                    ///< the corners of the current face or polyline
  std::vector<Vec3f> ring_;                           ///< the positions of polygon_
  std::vector<std::uint32_t> ringTriangles_;          ///< its triangles, as indices into polygon_
  const References& references_;
  bool isStrict_;
  std::size_t current_ = 0;                             ///< the subset that elements are added to
  std::map<std::string, std::size_t> subsets_{{"", 0}}; ///< subsets of the current object by material
  std::vector<std::string> libraries_;
  std::size_t linesTooShort_ = 0, pointStatements_ = 0, facesTooSmall_ = 0, fans_ = 0, colorsClamped_ = 0,
              unusableNormals_ = 0;
  std::set<std::string> skippedKeywords_; ///< at most maxNamedKeywords of them
};

} // namespace

bool resemblesObj(ByteSpan bytes) {
  constexpr std::string_view keywords[] = {"v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl"};
  const std::string name;
  for (TextScanner scanner(bytes, name); !scanner.atEnd(); scanner.skipLine()) {
    scanner.skipBlanks();
    const std::string_view word = scanner.word();
    if (!word.empty() && word.front() != '#')
      return std::ranges::find(keywords, word) != std::end(keywords);
  }
  return false;
}

Imported readObj(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  if (bytes.size() > maxObjBytes)
    throw Error(ErrorKind::limit, name, "OBJ files are read up to 8 GiB; binary PLY has no such limit");
  const References references(options, name);
  return ObjReader(bytes, name, references, options.strict).read();
}

} // namespace imgeo
