#pragma once
// Cube, Cone, Cylinder, Sphere and AsciiText of VRML 1.0 as X3D Shapes.

#include "import/vrml1/appearances.h"

namespace imgeo::vrml1 {

class Shapes {
public:
  Shapes(x3d::VrmlElements& elements, Appearances& appearances, Report& report)
      : elements_(elements), appearances_(appearances), report_(report) {}

  /// Adds the shapes of a node to `parent`: one for each part where parts have materials of their own.
  void add(pugi::xml_node parent, const Node& node, Properties& properties);

private:
  /// The current materials of the parts of a shape; a single one where all parts have the same.
  std::vector<Surface> surfacesOfParts(const Node& node, Properties& properties, std::size_t parts) const;
  pugi::xml_node addShape(pugi::xml_node parent, const Node& node, const Surface& surface, const char* geometry,
                          Properties& properties);
  void addRound(pugi::xml_node parent, const Node& node, Properties& properties);
  void addCube(pugi::xml_node parent, const Node& node, Properties& properties);
  void addText(pugi::xml_node parent, const Node& node, Properties& properties);

  x3d::VrmlElements& elements_;
  Appearances& appearances_;
  Report& report_;
};

} // namespace imgeo::vrml1
