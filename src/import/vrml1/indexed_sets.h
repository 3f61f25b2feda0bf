#pragma once
// IndexedFaceSet, IndexedLineSet and PointSet of VRML 1.0 as X3D Shapes: the coordinates, normals, texture coordinates
// and materials that they use of the current lists become their own.

#include "import/vrml1/appearances.h"

#include <map>
#include <string>
#include <vector>

namespace imgeo::vrml1 {

/// A face or a line: corners of coordIndex from `begin` to `end`, and its number among all in the node.
struct Run {
  std::size_t begin = 0, end = 0, number = 0;
};

class IndexedSets {
public:
  IndexedSets(x3d::VrmlElements& elements, const x3d::VrmlTokens& tokens, Appearances& appearances, Report& report)
      : elements_(elements), tokens_(tokens), appearances_(appearances), report_(report) {}

  /// Adds the shapes of an IndexedFaceSet, IndexedLineSet or PointSet to `parent`: more than one where its faces have
  /// materials that a list of colours does not express. Indices out of range are an omission.
  void add(pugi::xml_node parent, const Node& node, Properties& properties);

private:
  struct Content;

  // Those with a result return false after they have reported an index out of range.
  bool readContent(const Node& node, Properties& properties, Content& content);
  bool bindMaterials(const Node& node, Properties& properties, Content& content);
  void bindNormals(const Node& node, Properties& properties, Content& content);
  bool bindTextureCoordinates(const Node& node, Properties& properties, Content& content);
  std::vector<std::vector<Run>> groupedByMaterial(const Content& content);
  bool isInRange(const Node& node, std::size_t index, std::size_t count, const char* what);
  void addShape(pugi::xml_node parent, const Node& node, const Content& content, const std::vector<Run>& runs,
                Properties& properties);
  void addGeometry(pugi::xml_node shape, const Node& node, const Content& content, const std::vector<Run>& runs,
                   const std::vector<std::size_t>& colors);
  void addColors(pugi::xml_node geometry, const Node& node, const Content& content, const std::vector<Run>& runs,
                 const std::vector<std::size_t>& colors);

  x3d::VrmlElements& elements_;
  const x3d::VrmlTokens& tokens_;
  Appearances& appearances_;
  Report& report_;
  std::map<std::string, pugi::xml_node> written_; ///< geometries by node and all that they use
};

} // namespace imgeo::vrml1
