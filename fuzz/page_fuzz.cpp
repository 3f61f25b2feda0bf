#include "base/bytes.h"
#include "base/error.h"
#include "markup/x3d_element.h"

#include <cstdlib>

/// Fuzzes parsePage: a page is refused with its name, or gives an <x3d> element whose elements stand where the text has
/// their names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  const auto require = [](bool condition) {
    if (!condition)
      std::abort();
  };
  const std::string_view html = asText({data, size});
  try {
    const X3dElement x3d = parsePage(html, "fuzz.html");
    struct Walker : pugi::xml_tree_walker {
      bool for_each(pugi::xml_node& node) override {
        if (node.type() != pugi::node_element)
          return true;
        const std::string_view name = node.name();
        isRight = isRight && html.substr(offsets->of(node) + 1, name.size()) == name;
        return depth() <= static_cast<int>(maxPageDepth);
      }
      std::string_view html;
      const ElementOffsets* offsets = nullptr;
      bool isRight = true;
    } walker;
    walker.html = html;
    walker.offsets = &x3d.offsets;
    pugi::xml_node document = x3d.root().parent();
    require(document.traverse(walker) && walker.isRight);
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with("fuzz.html"));
  }
  return 0;
}
