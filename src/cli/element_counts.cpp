#include "cli/element_counts.h"

#include "cli/terminal.h"

namespace imgeo::cli {

std::string listed(const ElementCounts& counts) {
  std::string text;
  for (const Topology kind : allTopologies)
    if (counts.of(kind) > 0)
      text += (text.empty() ? "" : ", ") + grouped(counts.of(kind)) + " " + nameOf(kind);
  return text.empty() ? "0 triangles" : text;
}

} // namespace imgeo::cli
