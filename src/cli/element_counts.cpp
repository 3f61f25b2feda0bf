#include "cli/element_counts.h"

#include "cli/terminal.h"

namespace imgeo::cli {

std::string listed(const ElementCounts& counts) {
  std::string text;
  for (const Topology kind : allTopologies)
    if (const std::size_t count = counts.of(kind); count > 0) {
      const std::string_view plural = nameOf(kind);
      text += text.empty() ? "" : ", ";
      text += grouped(count) + " ";
      text += plural.substr(0, plural.size() - (count == 1)); // "1 line"
    }
  return text.empty() ? "0 triangles" : text;
}

} // namespace imgeo::cli
