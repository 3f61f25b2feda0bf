#include "documents/documents.h"

#include "documents/fields.h"
#include "documents/find_x3d.h"
#include "documents/read_geometry.h"
#include "documents/text.h"

#include <map>

namespace imgeo {

namespace {

constexpr std::size_t maxDocumentBytes = 64u << 20; // some hundred thousand patches
constexpr std::size_t maxDepth = 64;

/// The first child element of a name; a null node where there is none.
pugi::xml_node childNamed(const pugi::xml_node& parent, const char* name) {
  for (const pugi::xml_node& child : parent.children())
    if (sameName(child.name(), name))
      return child;
  return {};
}

class SceneReader {
public:
  SceneReader(const DocumentText& source) : source_(source) {}

  SceneDocument read(const pugi::xml_node& x3d) {
    document_.headlight = true;
    bool found = false;
    for (const pugi::xml_node& child : x3d.children())
      if (sameName(child.name(), "Scene")) {
        if (found)
          fail(child, ErrorKind::malformed, "there are two Scenes");
        found = true;
        readChildren(child, 1);
      }
    if (!found)
      fail(x3d, ErrorKind::malformed, "there is no Scene in the X3D element");
    return std::move(document_);
  }

private:
  [[noreturn]] void fail(const pugi::xml_node& node, ErrorKind kind, const std::string& message) const {
    imgeo::fail(source_, node, kind, message);
  }

  void readChildren(const pugi::xml_node& parent, std::size_t depth) {
    if (depth > maxDepth)
      fail(parent, ErrorKind::limit, "elements are nested too deeply");
    for (const pugi::xml_node& node : parent.children()) {
      const Fields fields(source_, node);
      const auto is = [&](const char* name) { return sameName(node.name(), name); };
      if (is("Group"))
        readGroup(fields, depth + 1);
      else if (is("Shape"))
        readShape(fields);
      else if (is("Viewpoint"))
        readViewpoint(fields);
      else if (is("DirectionalLight"))
        readLight(fields);
      else if (is("WorldInfo"))
        document_.title = validText(fields.text("title"));
      else if (is("NavigationInfo"))
        document_.headlight = fields.boolean("headlight", true);
      else if (node.first_child().type() == pugi::node_element)
        fail(node, ErrorKind::unsupported, "shapes inside of this element cannot be read back");
    }
  }

  /// A Group that stands for one Shape (see x3dom_element.h) becomes that Shape again.
  void readGroup(const Fields& fields, std::size_t depth) {
    const std::size_t first = document_.shapes.size();
    readChildren(fields.node(), depth);
    const std::string name = fields.text("DEF");
    if (!sharesAppearance(fields.node()))
      return;
    for (std::size_t i = first + 1; i < document_.shapes.size(); ++i)
      if (!sameButForPatches(document_.geometries[i], document_.geometries[first]))
        return;
    GeometryDescription& geometry = document_.geometries[first];
    for (std::size_t i = first + 1; i < document_.geometries.size(); ++i)
      for (PatchDescription& patch : document_.geometries[i].patches)
        geometry.patches.push_back(std::move(patch));
    geometry.box = fields.box();
    document_.shapes[first].name = name;
    document_.shapes.resize(first + 1);
    document_.geometries.resize(first + 1);
  }

  /// Whether a Group holds Shapes alone, all of them with the first's Appearance.
  bool sharesAppearance(const pugi::xml_node& group) const {
    std::string first;
    for (const pugi::xml_node& shape : group.children()) {
      if (shape.type() != pugi::node_element)
        continue;
      const Fields appearance(source_, childNamed(shape, "Appearance"));
      const std::string name = appearance.text(first.empty() ? "DEF" : "USE");
      if (!sameName(shape.name(), "Shape") || name.empty() || (!first.empty() && name != first))
        return false;
      first = name;
    }
    return !first.empty();
  }

  static bool sameButForPatches(GeometryDescription a, const GeometryDescription& b) {
    a.patches = b.patches;
    a.box = b.box;
    return a == b;
  }

  void readViewpoint(const Fields& fields) {
    Viewpoint viewpoint;
    viewpoint.description = validText(fields.text("description"));
    viewpoint.position = fields.vec3("position", viewpoint.position);
    if (const std::vector<double> turn = fields.reals("orientation", 4); !turn.empty()) {
      viewpoint.orientationAxis = {turn[0], turn[1], turn[2]};
      viewpoint.orientationAngle = turn[3];
    }
    viewpoint.fieldOfView = fields.real("fieldOfView", viewpoint.fieldOfView);
    viewpoint.centerOfRotation = fields.vec3("centerOfRotation", viewpoint.centerOfRotation);
    document_.viewpoints.push_back(std::move(viewpoint));
  }

  void readLight(const Fields& fields) {
    if (!fields.boolean("on", true))
      return;
    DirectionalLight light;
    light.direction = fields.vec3("direction", light.direction);
    light.color = fields.vec3("color", light.color);
    light.intensity = fields.real("intensity", light.intensity);
    document_.lights.push_back(light);
  }

  void readMaterial(const Fields& fields, Material& material) const {
    material.diffuseColor = fields.vec3("diffuseColor", material.diffuseColor);
    material.specularColor = fields.vec3("specularColor", material.specularColor);
    material.emissiveColor = fields.vec3("emissiveColor", material.emissiveColor);
    material.ambientIntensity = fields.real("ambientIntensity", material.ambientIntensity);
    material.shininess = fields.real("shininess", material.shininess);
    material.transparency = fields.real("transparency", material.transparency);
  }

  void readAppearance(const Fields& fields, Material& material) {
    if (const std::string use = fields.text("USE"); !use.empty()) {
      const auto defined = materials_.find(use);
      if (defined == materials_.end())
        fields.fail(ErrorKind::malformed, "USE names no Appearance that stands before");
      material = defined->second;
      return;
    }
    for (const pugi::xml_node& node : fields.node().children())
      if (sameName(node.name(), "Material"))
        readMaterial(Fields(source_, node), material);
    if (const std::string def = fields.text("DEF"); !def.empty())
      materials_[def] = material;
  }

  void readShape(const Fields& fields) {
    Shape shape;
    shape.name = fields.text("DEF");
    shape.mesh = document_.geometries.size();
    bool patchless = false; // the geometry node itself is its only patch
    for (const pugi::xml_node& child : fields.node().children()) {
      if (child.type() != pugi::node_element)
        continue;
      if (sameName(child.name(), "Appearance")) {
        readAppearance(Fields(source_, child), shape.material);
      } else if (sameName(child.name(), "ImageGeometry")) {
        document_.geometries.push_back(readGeometry(source_, child, Container::sig));
        patchless = !childNamed(child, "GeometryPatch");
      } else if (sameName(child.name(), "BinaryGeometry")) {
        document_.geometries.push_back(readGeometry(source_, child, Container::bg));
        patchless = !childNamed(child, "GeometryPatch");
      } else {
        fail(child, ErrorKind::unsupported, "a Shape's geometry is neither ImageGeometry nor BinaryGeometry");
      }
    }
    if (document_.geometries.size() != shape.mesh + 1)
      fail(fields.node(), ErrorKind::malformed, "a Shape has no geometry, or more than one");
    GeometryDescription& geometry = document_.geometries.back();
    geometry.box = fields.box();
    if (patchless)
      geometry.patches[0].box = geometry.box;
    document_.shapes.push_back(std::move(shape));
  }

  const DocumentText& source_;
  SceneDocument document_;
  std::map<std::string, Material> materials_; ///< by the DEF of their Appearance
};

/// pugixml leaves references that it does not know as text; we refuse them.
void checkReferences(std::string_view text, const std::string& name, TextSpan span) {
  for (std::size_t at = text.find('&', span.begin); at < span.end; at = text.find('&', at + 1)) {
    const std::string_view rest = text.substr(at + 1, 12);
    const std::string_view entity = rest.substr(0, rest.find(';'));
    const bool known = entity == "amp" || entity == "lt" || entity == "gt" || entity == "quot" ||
                       entity == "apos" || (entity.size() > 1 && entity[0] == '#');
    if (!known || entity.size() == rest.size())
      throw Error(ErrorKind::malformed, placeOf(text, name, at),
                  "an ampersand begins no character reference that we know");
  }
}

} // namespace

SceneDocument readScene(std::string_view text, const std::string& name) {
  if (text.size() > maxDocumentBytes)
    throw Error(ErrorKind::limit, name, "the document is larger than 64 MiB");
  const TextSpan span = findX3d(text, name);
  checkReferences(text, name, span);
  pugi::xml_document parsed;
  const pugi::xml_parse_result result = parsed.load_buffer(text.data() + span.begin, span.end - span.begin,
                                                           pugi::parse_default, pugi::encoding_utf8);
  if (!result)
    throw Error(ErrorKind::malformed,
                placeOf(text, name, span.begin + static_cast<std::size_t>(result.offset)),
                std::string("not well-formed: ") + result.description());
  const DocumentText source{text, name, span.begin};
  return SceneReader(source).read(parsed.document_element());
}

} // namespace imgeo
