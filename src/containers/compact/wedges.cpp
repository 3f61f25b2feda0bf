#include "containers/compact/wedges.h"

namespace imgeo::compact {

Wedges plainWedges(const Connectivity& connectivity) {
  Wedges wedges;
  wedges.ofCorner = connectivity.vertex;
  wedges.previous.assign(connectivity.vertexCount, none);
  wedges.corner.assign(connectivity.vertexCount, none);
  for (std::uint32_t vertex = 0; vertex < connectivity.vertexCount; ++vertex)
    wedges.vertex.push_back(vertex);
  for (std::uint32_t corner = static_cast<std::uint32_t>(connectivity.vertex.size()); corner-- > 0;)
    wedges.corner[connectivity.vertex[corner]] = corner;
  return wedges;
}

} // namespace imgeo::compact
