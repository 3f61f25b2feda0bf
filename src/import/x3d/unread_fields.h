#pragma once
// Fields that nothing reads, of nodes that pages draw and of nodes that convert writes as others. Together with the
// tables of docs/formats/nodes.md they are all fields that X3D gives these nodes (tests/nodes.test.ts), so that none is
// dropped in silence.

#include "import/x3d/elements.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

struct UnreadField {
  std::string_view node, field;
  std::string_view defaultText; ///< in the XML encoding
  /// Why it has no effect; "" for hints, and where no program would show a difference in a still scene.
  std::string_view reason;
};

std::span<const UnreadField> unreadFields();

/// Adds a warning for each reason, with the fields that the document states with another value than the default.
void warnOfUnreadFields(const Elements& elements, std::vector<std::string>& warnings);

} // namespace imgeo::x3d
