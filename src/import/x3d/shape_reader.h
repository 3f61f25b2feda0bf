#pragma once
// The shapes of an X3D document whose geometry becomes a mesh.

#include "import/import.h"
#include "import/references.h"
#include "import/x3d/container_geometry.h"
#include "import/x3d/faults.h"
#include "import/x3d/geometry.h"
#include "import/x3d/recordings.h"
#include "import/x3d/routes.h"
#include "import/x3d/shared_patches.h"
#include "import/x3d/source.h"
#include "import/x3d/summary.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// A mesh whose vertices move: what is to become children of its Shape.
struct RecordedMesh {
  std::size_t mesh = 0;
  std::vector<pugi::xml_node> replaced; ///< nodes of the geometry at which routes end that the mesh does not need
  MovingVertices moving;                ///< with Interpolator::points, or with paths in url and video
};

class ShapeReader {
public:
  /// Adds meshes, attributes and warnings to `imported`. Everything must outlive this.
  ShapeReader(const Source& source, const References& references, const ImportOptions& options, Imported& imported,
              Summary& summary, Faults& faults, const Routes& routes);

  /// The shapes of a geometry node: one, or one for each kind of element of a container that draws several. They have
  /// the same meshes in all its USEs. Empty for geometry that stays in the document, which is read too, to report its
  /// errors. `isForCubeMap`: its generator is drawn as it is.
  std::vector<Shape> shapesOf(pugi::xml_node geometry, bool isForCubeMap);

  /// The shapes of an ExternalShape, with its materials. Empty where it cannot be read, which is noted.
  std::vector<Shape> shapesOfExternal(pugi::xml_node externalShape);

  /// The shape of a Shape that hasSharedPatch(); see SharedPatches::shapeOf.
  std::optional<Shape> shapeOfSharedPatch(pugi::xml_node element);

  /// One shape of geometries that each have a patch of it (geometriesOfPatches). Empty where that fails: then each is a
  /// Shape of its own.
  std::optional<Shape> shapeOfPatches(const std::vector<pugi::xml_node>& geometries);

  /// The meshes so far whose vertices move.
  const std::vector<RecordedMesh>& recorded() const { return recorded_; }

  /// To be called after all shapes: adds the names of attributes, and warnings about shared patches.
  void finish();

private:
  bool staysInline(pugi::xml_node node) const;
  void record(pugi::xml_node node, std::size_t mesh, MovingVertices moving, Geometry& geometry);
  std::optional<MovingVertices> framesOf(pugi::xml_node node) const;
  Shape addShape(Mesh mesh, bool isSolid);
  bool operate(pugi::xml_node node, Mesh& mesh);
  std::vector<Shape> shapesOfFiles(pugi::xml_node node);
  std::vector<Shape> shapesOfResource(pugi::xml_node node, gltf::ShapeResource resource);
  std::size_t addAppearance(gltf::ResourceMaterial material);
  /// Calls `read` and turns its Error into a warning that `node` is left out, or if strict into the document's Error.
  template <typename Read> auto attemptFiles(pugi::xml_node node, const Read& read) -> decltype(read());
  void noteDataOf(pugi::xml_node geometry);

  const Source& source_;
  const References& references_;
  Imported& imported_;
  Summary& summary_;
  Faults& faults_;
  const Routes& routes_;
  std::size_t inlineBytes_;
  Recordings recordings_;
  bool readsFrames_;
  bool readsSolids_;
  const AttributeChoice& keptAttributes_;
  AttributeChoice mappings_;  ///< keptAttributes_ and the sets of texture coordinates that textures use
  DocumentWarnings warnings_; ///< of fields, in the list of `imported_`
  ContainerGeometries containers_;
  std::set<std::string> attributes_; ///< names of the vertex attributes of geometries of files
  SharedPatches sharedPatches_;
  std::vector<RecordedMesh> recorded_;
  std::map<pugi::xml_node_struct*, std::vector<Shape>> converted_; ///< by geometry node
};

} // namespace imgeo::x3d
