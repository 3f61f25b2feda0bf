#include "import/vrml1/properties.h"

#include <map>

namespace imgeo::vrml1 {

std::optional<Property> propertyOf(std::string_view type) {
  static const std::map<std::string_view, Property> properties{{"Coordinate3", Property::coordinates},
                                                               {"FontStyle", Property::fontStyle},
                                                               {"Material", Property::material},
                                                               {"MaterialBinding", Property::materialBinding},
                                                               {"Normal", Property::normals},
                                                               {"NormalBinding", Property::normalBinding},
                                                               {"ShapeHints", Property::shapeHints},
                                                               {"Texture2", Property::texture},
                                                               {"Texture2Transform", Property::textureTransform},
                                                               {"TextureCoordinate2", Property::textureCoordinates}};
  const auto found = properties.find(type);
  return found == properties.end() ? std::nullopt : std::optional(found->second);
}

const Node* Properties::get(Property property) {
  note(index(property));
  return nodes_[index(property)];
}

void Properties::note(std::size_t property) {
  for (Record& record : records_)
    if (record.before[property] == nodes_[property])
      record.read.set(property);
}

void Properties::read(const PropertySet& properties) {
  for (std::size_t i = 0; i < propertyCount; ++i)
    if (properties[i])
      note(i);
}

PropertySet Properties::endRecord() {
  const PropertySet read = records_.back().read;
  records_.pop_back();
  return read;
}

} // namespace imgeo::vrml1
