#pragma once
// The current properties of VRML 1.0's traversal: nodes that apply to the shapes after them. They also record which
// properties a named Separator takes from outside, so that its USE under the same properties is the same X3D node.

#include "import/vrml1/tree.h"

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace imgeo::vrml1 {

enum class Property : std::uint8_t {
  coordinates,
  normals,
  normalBinding,
  material,
  materialBinding,
  texture,
  textureTransform,
  textureCoordinates,
  shapeHints,
  fontStyle
};

inline constexpr std::size_t propertyCount = 10;
using PropertyNodes = std::array<const Node*, propertyCount>; ///< null: the default
using PropertySet = std::bitset<propertyCount>;

/// The property that a node of this type sets.
std::optional<Property> propertyOf(std::string_view type);

class Properties {
public:
  void set(Property property, const Node& node) { nodes_[index(property)] = &node; }
  /// The current node of a property; null for the default.
  const Node* get(Property property);

  const PropertyNodes& nodes() const { return nodes_; }
  void restore(const PropertyNodes& nodes) { nodes_ = nodes; }

  /// Records, until endRecord, which of the current properties are read before they are set.
  void beginRecord() { records_.push_back({nodes_, {}}); }
  PropertySet endRecord();
  /// Reads properties on behalf of a subtree that is used again.
  void read(const PropertySet& properties);

  static std::size_t index(Property property) { return static_cast<std::size_t>(property); }

private:
  struct Record {
    PropertyNodes before;
    PropertySet read;
  };

  void note(std::size_t property);

  PropertyNodes nodes_{};
  std::vector<Record> records_;
};

} // namespace imgeo::vrml1
