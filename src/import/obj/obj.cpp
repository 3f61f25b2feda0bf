#include "import/obj/obj.h"
#include "base/error.h"
#include "import/mesh/add_shape.h"
#include "import/mesh/far_origin.h"
#include "import/obj/materials.h"
#include "import/obj/object_shapes.h"
#include "import/obj/statements.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace imgeo {

namespace {

/// Bounds corners and vertices to 32 bits, since each takes at least two bytes.
constexpr std::uint64_t maxObjBytes = std::uint64_t{8} << 30;

class ObjReader : private ObjSink {
public:
  ObjReader(ByteSpan bytes, const std::string& name, const References& references, const ImportOptions& options)
      : statements_(bytes, name, options.origin, *this), fileName_(name), references_(references),
        isStrict_(options.strict) {}

  Imported read() {
    statements_.read();
    content_.objects = std::move(statements_.objects());
    std::erase_if(content_.objects,
                  [](const ObjObject& object) { return object.triangles.empty() && object.lines.empty(); });
    Imported imported;
    imported.format = "OBJ";
    const bool hasElements = !content_.objects.empty();
    if (hasElements)
      addObjects(imported);
    else
      addPoints(imported.scene);
    setOrigin(imported, statements_.origin());
    statements_.addWarnings(imported.warnings, hasElements);
    return imported;
  }

private:
  void addVertex(const Vec3f& position, const Rgba* color) override {
    if (color) {
      content_.colors.resize(content_.positions.size(), Rgba(1, 1, 1, 1)); // for earlier vertices without colours
      content_.colors.push_back(*color);
    }
    content_.positions.push_back(position);
  }
  void addTexCoord(const Vec2f& texCoord) override { content_.texCoords.push_back(texCoord); }
  void addNormal(const Vec3f& normal) override { content_.normals.push_back(normal); }
  Vec3f positionOf(std::uint32_t index) const override { return content_.positions[index]; }
  void addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) override {
    object.triangles.insert(object.triangles.end(), corners.begin(), corners.end());
  }
  void addLine(ObjObject& object, const std::array<ObjCorner, 2>& corners) override {
    object.lines.insert(object.lines.end(), corners.begin(), corners.end());
  }

  void addObjects(Imported& imported) {
    ObjMaterials materials(imported.scene.graph, references_);
    for (const std::string& library : statements_.libraries())
      materials.readLibrary(library);
    ObjMeshBuilder builder(content_);
    // Makes the subsets of each object consecutive.
    std::ranges::stable_sort(content_.objects, {}, &ObjObject::index);
    const ObjMeshSource meshOf = [&](const ObjObject& subset, Topology topology) -> std::optional<Mesh> {
      if ((topology == Topology::triangles ? subset.triangles : subset.lines).empty())
        return std::nullopt;
      return builder.build(subset, topology);
    };
    addObjectShapes(imported.scene, content_.objects, meshOf, materials, fileName_);
    warnOfPartialNormals(imported.warnings, builder.objectsWithPartialNormals);
    addOmissions(imported.warnings, materials.omissions(), isStrict_, fileName_);
    materials.addWarnings(imported.warnings);
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

  ObjStatements statements_;
  const std::string& fileName_;
  ObjContent content_;
  const References& references_;
  bool isStrict_;
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
  const std::optional<Bytes> text = withLineFeeds(bytes);
  return ObjReader(text ? ByteSpan(*text) : bytes, name, references, options).read();
}

} // namespace imgeo
