#include "documents/documents.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace imgeo {

std::vector<std::size_t> append(SceneDocument& document, SceneDocument&& more) {
  std::vector<std::size_t> roots = append(document.graph, std::move(more.graph), document.geometries.size());
  std::ranges::move(more.geometries, std::back_inserter(document.geometries));
  for (const auto& [name, count] : more.otherElements)
    document.otherElements[name] += count;
  for (const auto& [name, count] : more.geometryElements)
    document.geometryElements[name] += count;
  for (const auto& [name, count] : more.choiceElements)
    document.choiceElements[name] += count;
  std::ranges::move(more.warnings, std::back_inserter(document.warnings));
  return roots;
}

} // namespace imgeo
