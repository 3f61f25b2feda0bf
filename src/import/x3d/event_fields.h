#pragma once
// The fields of X3D's nodes that routes connect, with their types and directions (ISO/IEC 19775-1:2023).

#include <cstdint>
#include <optional>
#include <string_view>

namespace imgeo::x3d {

enum class FieldAccess : std::uint8_t { inputOnly, outputOnly, inputOutput };

struct EventField {
  std::string_view type; ///< "SFVec3f"; "" where the table does not know it
  FieldAccess access = FieldAccess::inputOutput;
};

/// The field of a node that an end of a route names; of an inputOutput field also as "set_NAME" and "NAME_changed".
/// Empty for a name that is no field of the node: for nodes whose fields the table does not know, never.
std::optional<EventField> eventField(std::string_view element, std::string_view field);

} // namespace imgeo::x3d
