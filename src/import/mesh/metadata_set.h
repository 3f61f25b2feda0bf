#pragma once
// A MetadataSet of values that a source states and nothing displays, such as its place on the earth.

#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo {

class MetadataSet {
public:
  explicit MetadataSet(SceneGraph& graph) : graph_(graph) {}

  /// `element`: MetadataDouble, MetadataInteger ...; `value`: as the field is written.
  void add(const char* element, const char* name, std::string value);
  /// A MetadataString; nothing where the text is empty.
  void addText(const char* name, const std::string& text);

  /// Adds the set to a node, in its field `metadata`.
  void addTo(std::size_t node, const char* name);

private:
  SceneGraph& graph_;
  std::vector<std::size_t> values_;
};

} // namespace imgeo
