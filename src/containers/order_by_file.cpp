#include "containers/order_by_file.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace imgeo {

namespace {

/// The file of the first patch; empty: there is none that geometries share.
std::string_view fileOf(const GeometryDescription& geometry) {
  if (geometry.patches.empty())
    return {};
  const PatchDescription& patch = geometry.patches.front();
  if (patch.data)
    return patch.data->url;
  return patch.coord.empty() ? std::string_view() : std::string_view(patch.coord.front().url);
}

} // namespace

std::vector<std::size_t> orderByFile(std::span<const GeometryDescription> geometries) {
  std::unordered_map<std::string_view, std::size_t> firstOfFile;
  std::vector<std::size_t> first(geometries.size());
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    const std::string_view file = fileOf(geometries[i]);
    first[i] = file.empty() ? i : firstOfFile.try_emplace(file, i).first->second;
  }
  std::vector<std::size_t> order(geometries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return first[i]; });
  return order;
}

} // namespace imgeo
