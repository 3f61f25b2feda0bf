#pragma once
// Helpers for tests of readers of point clouds.

#include "import/import.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace imgeo::testing {

/// Options that keep all values of points.
inline ImportOptions keepingAll() {
  ImportOptions options;
  options.attributes.all = true;
  return options;
}

/// Values by their names.
inline std::map<std::string, std::vector<float>> valuesOf(const Mesh& mesh) {
  std::map<std::string, std::vector<float>> values;
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    values[attribute.name] = attribute.values;
  return values;
}

/// The value of a field of the first georeference; empty where there is none.
inline std::string metadata(const Imported& imported, const std::string& name) {
  for (const Node& node : imported.scene.graph.nodes) {
    const auto field = [&](const char* key) {
      const auto found = std::ranges::find(node.fields, std::string(key), &FieldText::name);
      return found == node.fields.end() ? std::string() : found->value;
    };
    if (field("name") == name && field("containerField") == "value")
      return field("value");
  }
  return "";
}

/// Whether a warning contains the text.
inline bool hasWarning(const Imported& imported, const std::string& text) {
  return std::ranges::any_of(imported.warnings,
                             [&](const std::string& warning) { return warning.find(text) != warning.npos; });
}

} // namespace imgeo::testing
