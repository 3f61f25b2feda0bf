#pragma once
// Materials and textures of VRML 1.0 as X3D Appearances, of which equal ones are one node.

#include "import/vrml/elements.h"
#include "import/vrml1/properties.h"
#include "import/vrml1/report.h"

#include <map>
#include <optional>
#include <string>

namespace imgeo::vrml1 {

/// One material of a Material node, whose fields are lists.
struct Surface {
  Vec3d diffuse{0.8, 0.8, 0.8}, emissive, specular;
  double shininess = 0.2, transparency = 0;
  std::optional<double> ambientIntensity; ///< X3D's: ambient by diffuse; only where the source states an ambient colour
  friend bool operator==(const Surface&, const Surface&) = default;
};

/// The materials of a Material node, or the default material for null. They are cycled by the length of the longest
/// field; shorter fields repeat their last value.
class Surfaces {
public:
  explicit Surfaces(const Node* material);
  std::size_t count() const { return count_; }
  Surface at(std::size_t index) const;
  /// Whether materials may differ in more than diffuse colour and transparency.
  bool differInMoreThanColor() const;

private:
  const Node* material_;
  std::size_t count_ = 1;
};

/// The color of lines and points, which VRML 1.0 does not light.
Vec3d unlitColor(const Surface& surface);

/// "0.5 1 0"
std::string textOf(const Vec3d& v);

class Appearances {
public:
  Appearances(x3d::VrmlElements& elements, Report& report) : elements_(elements), report_(report) {}

  /// Whether the current Texture2 has an image: an empty one turns textures off.
  static bool isTextured(Properties& properties);
  /// Adds an Appearance to a Shape, with a USE where there is an equal one. `isLit` is false for lines and points.
  void add(pugi::xml_node shape, const Node& where, const Surface& surface, bool isLit, Properties& properties);

private:
  void addMaterial(pugi::xml_node appearance, const Node& where, const Surface& surface, bool isLit);
  void addTexture(pugi::xml_node appearance, const Node& where, const Node& texture);
  void addTextureTransform(pugi::xml_node appearance, const Node& where, const Node& node);

  x3d::VrmlElements& elements_;
  Report& report_;
  std::map<std::string, pugi::xml_node> written_; ///< by their content as XML
};

} // namespace imgeo::vrml1
