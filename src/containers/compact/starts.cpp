#include "containers/compact/starts.h"

#include "base/parallel.h"
#include "containers/compact/connectivity.h"

#include <algorithm>
#include <utility>

namespace imgeo::compact {

namespace {

/// What a vertex without a second parallelogram costs more than another, in bits. With it, the bytes of connectivity
/// rank orders nearly as whole patches do.
constexpr std::size_t bitsWithoutSecond = 2;

/// The size of a patch in the order that begins with a triangle, in bits, but for what is the same in all orders.
std::size_t estimatedSize(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount, std::uint32_t first) {
  std::vector<std::uint32_t> sourceCorner;
  RangeEncoder encoder(connectivityModels);
  const Connectivity connectivity = encodeTriangles(encoder, vertices, vertexCount, first, sourceCorner);
  return 8 * encoder.finish().size() +
         bitsWithoutSecond * static_cast<std::size_t>(std::ranges::count(connectivity.second, none));
}

} // namespace

void appendStarts(std::vector<std::uint32_t>& starts, std::span<const std::uint32_t> vertices,
                  std::uint32_t vertexCount, const Search& search) {
  const std::size_t triangleCount = vertices.size() / 3;
  const auto triangleAt = [&](std::size_t i, std::size_t parts) {
    return static_cast<std::uint32_t>(triangleCount * i / parts);
  };
  for (std::uint32_t i = 0; i < search.spread; ++i)
    if (search.known == 0 || i * search.known % search.spread != 0)
      starts.push_back(triangleAt(i, search.spread));
  const std::size_t tried = std::min<std::size_t>(search.tried, triangleCount);
  std::vector<std::pair<std::size_t, std::uint32_t>> ranked(tried); // size, first triangle
  parallelFor(tried, [&](std::size_t i) {
    const std::uint32_t triangle = triangleAt(i, tried);
    ranked[i] = {estimatedSize(vertices, vertexCount, triangle), triangle};
  });
  std::erase_if(ranked, [&](const auto& order) { return std::ranges::find(starts, order.second) != starts.end(); });
  std::ranges::sort(ranked);
  ranked.resize(search.promising);
  for (const auto& [size, triangle] : ranked)
    starts.push_back(triangle);
}

} // namespace imgeo::compact
