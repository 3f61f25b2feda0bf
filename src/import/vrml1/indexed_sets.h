#pragma once
// IndexedFaceSet, IndexedLineSet and PointSet of VRML 1.0 as X3D Shapes: each has its own copy of the coordinates,
// normals, texture coordinates and colours that it uses.

#include "import/vrml1/indexed_content.h"

#include <map>
#include <string>
#include <vector>

namespace imgeo::vrml1 {

class IndexedSets {
public:
  IndexedSets(x3d::VrmlElements& elements, const x3d::VrmlTokens& tokens, Appearances& appearances, Report& report)
      : elements_(elements), tokens_(tokens), appearances_(appearances), report_(report) {}

  /// Adds the shapes of an IndexedFaceSet, IndexedLineSet or PointSet to `parent`: more than one where its faces have
  /// materials that a list of colours does not express. A node with an index out of range is left out and reported.
  void add(pugi::xml_node parent, const Node& node, Properties& properties);

private:
  std::vector<std::vector<Run>> groupedByMaterial(const IndexedContent& content);
  void addShape(pugi::xml_node parent, const Node& node, const IndexedContent& content, const std::vector<Run>& runs,
                Properties& properties);
  void addGeometry(pugi::xml_node shape, const Node& node, const IndexedContent& content, const std::vector<Run>& runs,
                   const Indices& colors);
  void addColors(pugi::xml_node geometry, const Node& node, const IndexedContent& content, const std::vector<Run>& runs,
                 const Indices& colors);

  x3d::VrmlElements& elements_;
  const x3d::VrmlTokens& tokens_;
  Appearances& appearances_;
  Report& report_;
  std::map<std::string, pugi::xml_node> written_; ///< geometries without colours, by IndexedContent::key
};

} // namespace imgeo::vrml1
