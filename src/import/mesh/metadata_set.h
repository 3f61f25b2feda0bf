#pragma once
// A MetadataSet of values that a source states and nothing displays, such as its place on the earth.

#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo {

/// The name of the set that says where on the earth a model is.
inline constexpr const char* georeferenceName = "georeference";

class MetadataSet {
public:
  explicit MetadataSet(SceneGraph& graph) : graph_(graph) {}

  /// `element`: MetadataDouble, MetadataInteger ...; `value`: as the field is written.
  void add(const char* element, const char* name, std::string value);
  /// A MetadataString; nothing where the text is empty.
  void addText(const char* name, const std::string& text);

  /// A MetadataDouble of three values.
  void addPoint(const char* name, const Vec3d& point);

  /// Adds the set to a node, in its field `metadata`.
  void addTo(std::size_t node, const char* name);

private:
  SceneGraph& graph_;
  std::vector<std::size_t> values_;
};

} // namespace imgeo
