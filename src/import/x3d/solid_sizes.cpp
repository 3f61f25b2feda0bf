#include "import/x3d/solid_sizes.h"

#include "base/error.h"
#include "import/text/text_scanner.h"
#include "import/x3d/field_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string_view>

namespace imgeo::x3d {

namespace {

struct Size {
  std::string_view node, field;
  std::size_t count;
};

constexpr auto sizes = std::to_array<Size>({
    {"Arc2D", "radius", 1},
    {"ArcClose2D", "radius", 1},
    {"Box", "size", 3},
    {"Circle2D", "radius", 1},
    {"Cone", "bottomRadius", 1},
    {"Cone", "height", 1},
    {"Cylinder", "height", 1},
    {"Cylinder", "radius", 1},
    {"Disk2D", "outerRadius", 1},
    {"Rectangle2D", "size", 2},
    {"Sphere", "radius", 1},
});

} // namespace

void checkSizes(const Source& source, pugi::xml_node node) {
  const auto [begin, end] = std::ranges::equal_range(sizes, node.name(), {}, &Size::node);
  for (const Size& size : std::span(begin, end)) {
    const pugi::xml_attribute attribute = node.attribute(size.field.data());
    if (!attribute)
      continue;
    const std::string_view text = attribute.value();
    const auto numbers = parseReals(text);
    if (!numbers || numbers->size() != size.count ||
        std::ranges::any_of(*numbers, [](double n) { return !std::isfinite(n) || n < 0; }))
      source.fail(node, ErrorKind::malformed,
                  fmt::format("{} '{}' is not {}", size.field, asPrintable(text),
                              size.count == 1 ? "a size" : fmt::format("{} sizes", size.count)));
  }
}

} // namespace imgeo::x3d
