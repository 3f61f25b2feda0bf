#include "import/vrml1/shapes.h"

#include "scene/mf_string.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::vrml1 {

namespace {

bool hasPart(const Node& node, const char* part) {
  const Field* const parts = node.field("parts");
  return !parts ||
         std::ranges::any_of(parts->words, [&](const std::string& word) { return word == part || word == "ALL"; });
}

} // namespace

void Shapes::add(pugi::xml_node parent, const Node& node, Properties& properties) {
  if (node.is("Cube"))
    addCube(parent, node, properties);
  else if (node.is("AsciiText"))
    addText(parent, node, properties);
  else
    addRound(parent, node, properties);
}

std::vector<Surface> Shapes::surfacesOfParts(const Node& node, Properties& properties, std::size_t parts) const {
  const Surfaces surfaces(properties.get(Property::material));
  std::vector<Surface> result{surfaces.at(0)};
  if (surfaces.count() == 1)
    return result;
  const Node* const binding = properties.get(Property::materialBinding);
  const std::string value = binding ? binding->word("value", "OVERALL") : "OVERALL";
  const bool isByPart = value.starts_with("PER_PART") || (node.is("Cube") && value.starts_with("PER_FACE"));
  for (std::size_t part = 1; isByPart && part < parts; ++part)
    result.push_back(surfaces.at(part));
  const bool areEqual = std::ranges::all_of(result, [&](const Surface& each) { return each == result[0]; });
  if (areEqual)
    result.resize(1);
  return result;
}

pugi::xml_node Shapes::addShape(pugi::xml_node parent, const Node& node, const Surface& surface, const char* geometry,
                                Properties& properties) {
  pugi::xml_node shape = elements_.add(parent, "Shape", node.where);
  if (!node.name.empty())
    x3d::set(shape, "DEF", elements_.define(node.name, "Shape"));
  appearances_.add(shape, node, surface, true, properties);
  return elements_.add(shape, geometry, node.where);
}

/// Cone, Cylinder and Sphere.
void Shapes::addRound(pugi::xml_node parent, const Node& node, Properties& properties) {
  struct Part {
    const char *name, *field;
  };
  static const std::vector<Part> coneParts{{"SIDES", "side"}, {"BOTTOM", "bottom"}},
      cylinderParts{{"SIDES", "side"}, {"TOP", "top"}, {"BOTTOM", "bottom"}}, noParts;
  const std::vector<Part>& parts = node.is("Cone") ? coneParts : node.is("Cylinder") ? cylinderParts : noParts;
  const std::vector<Surface> surfaces = surfacesOfParts(node, properties, parts.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto isInShape = [&](const Part& part) {
      return hasPart(node, part.name) && (surfaces.size() == 1 || part.field == parts[i].field);
    };
    if (!parts.empty() && std::ranges::none_of(parts, isInShape))
      continue;
    pugi::xml_node geometry = addShape(parent, node, surfaces[i], node.type.c_str(), properties);
    for (const char* field : {"radius", "bottomRadius", "height"})
      if (const std::vector<double>& values = node.numbers(field); !values.empty())
        x3d::set(geometry, field, fmt::format("{}", values[0]));
    bool isClosed = true;
    for (const Part& part : parts)
      if (!isInShape(part)) {
        x3d::set(geometry, part.field, "false");
        isClosed &= hasPart(node, part.name); // another shape closes it
      }
    if (!isClosed)
      x3d::set(geometry, "solid", "false");
  }
}

void Shapes::addCube(pugi::xml_node parent, const Node& node, Properties& properties) {
  const Vec3d size{node.real("width", 2), node.real("height", 2), node.real("depth", 2)};
  const std::vector<Surface> surfaces = surfacesOfParts(node, properties, 6);
  if (surfaces.size() == 1) {
    x3d::set(addShape(parent, node, surfaces[0], "Box", properties), "size", vrml1::textOf(size));
    return;
  }
  // Front, back, left, right, top, bottom: corners as bits 1 (right), 2 (top) and 4 (front), from the lower left on.
  constexpr std::array<std::array<unsigned, 4>, 6> faces{
      {{4, 5, 7, 6}, {1, 0, 2, 3}, {0, 4, 6, 2}, {5, 1, 3, 7}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
  for (std::size_t face = 0; face < faces.size(); ++face) {
    pugi::xml_node geometry = addShape(parent, node, surfaces[face], "IndexedFaceSet", properties);
    x3d::set(geometry, "coordIndex", "0 1 2 3 -1");
    std::vector<std::string> points;
    for (const unsigned corner : faces[face])
      points.push_back(vrml1::textOf(Vec3d{corner & 1 ? size.x / 2 : -size.x / 2, corner & 2 ? size.y / 2 : -size.y / 2,
                                           corner & 4 ? size.z / 2 : -size.z / 2}));
    x3d::set(elements_.add(geometry, "Coordinate", node.where), "point", fmt::format("{}", fmt::join(points, " ")));
    x3d::set(elements_.add(geometry, "TextureCoordinate", node.where), "point", "0 0 1 0 1 1 0 1");
  }
}

void Shapes::addText(pugi::xml_node parent, const Node& node, Properties& properties) {
  if (surfacesOfParts(node, properties, node.field("string") ? node.field("string")->words.size() : 0).size() > 1)
    ++report_.textMaterials;
  const Surface surface = Surfaces(properties.get(Property::material)).at(0);
  pugi::xml_node text = addShape(parent, node, surface, "Text", properties);
  if (const Field* const strings = node.field("string"))
    x3d::set(text, "string", quoteStrings(strings->words));
  const std::vector<double>& widths = node.numbers("width");
  if (std::ranges::any_of(widths, [](double width) { return width > 0; }))
    x3d::set(text, "length", fmt::format("{}", fmt::join(widths, " ")));

  const Node* const font = properties.get(Property::fontStyle);
  pugi::xml_node style = elements_.add(text, "FontStyle", node.where);
  x3d::set(style, "size", fmt::format("{}", font ? font->real("size", 10) : 10));
  const std::string family = font ? font->word("family", "SERIF") : "SERIF";
  if (family != "SERIF")
    x3d::set(style, "family", family == "SANS" ? "\"SANS\"" : "\"TYPEWRITER\"");
  const Field* const words = font ? font->field("style") : nullptr;
  const auto hasStyle = [&](const char* word) {
    return words && std::ranges::find(words->words, word) != words->words.end();
  };
  if (hasStyle("BOLD") || hasStyle("ITALIC"))
    x3d::set(style, "style", fmt::format("{}{}", hasStyle("BOLD") ? "BOLD" : "", hasStyle("ITALIC") ? "ITALIC" : ""));
  const std::string justification = node.word("justification", "LEFT");
  if (justification != "LEFT")
    x3d::set(style, "justify", justification == "CENTER" ? "\"MIDDLE\"" : "\"END\"");
  if (node.field("spacing"))
    x3d::set(style, "spacing", fmt::format("{}", node.real("spacing", 1)));
}

} // namespace imgeo::vrml1
