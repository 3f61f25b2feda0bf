#pragma once
// Gives the Shapes of a document whose vertices move the interpolators that move them.

#include "import/x3d/shape_reader.h"
#include "scene/scene.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

class MovingMeshes {
public:
  /// Adds the interpolators as children of the first Shape of each mesh. `defined`: the nodes by DEF, to which
  /// sequences in files are added. `graph` must outlive this.
  MovingMeshes(SceneGraph& graph, const std::vector<RecordedMesh>& meshes, std::map<std::string, std::size_t>& defined);

  /// Whether an element is a Coordinate or a Normal that has become a part of a mesh with frames.
  bool replaces(pugi::xml_node element) const { return replaced_.contains(element.internal_object()); }

  /// Whether an element has become an interpolator with a sequence.
  bool has(pugi::xml_node element) const { return sequences_.contains(element.attribute("DEF").value()); }

  /// To be called when the graph has its routes: those to the document's interpolators lead to the Shapes' ones too.
  /// Removes interpolators that move nothing else.
  void finish();

private:
  void add(const RecordedMesh& mesh, std::size_t shape, std::map<std::string, std::size_t>& defined);

  SceneGraph& graph_;
  std::set<pugi::xml_node_struct*> replaced_;
  std::set<std::string, std::less<>> sequences_;             ///< DEFs of sequences in files
  std::map<std::size_t, std::vector<std::size_t>> copiesOf_; ///< of the document's interpolators
};

} // namespace imgeo::x3d
