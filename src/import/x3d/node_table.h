#pragma once
// The table of all nodes of X3D 4.0 (ISO/IEC 19775-1:2023), and of nodes of other programs that imgeo knows: what
// becomes of each. The readers, the summary and docs/formats/x3d-nodes.md follow it.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace imgeo::x3d {

enum class NodeTreatment : std::uint8_t {
  drawn,     ///< pages draw or play it, or it is a part of what they draw
  converted, ///< convert writes another node, which pages draw
  kept,      ///< stays in the document, without effect
  dropped,   ///< is left out with its children
};

struct NodeRow {
  std::string_view name;
  std::string_view component; ///< of X3D 4.0; where `level` is 0, the program that defines the node, or "statement"
  int level = 0;              ///< of the component
  std::string_view containerField; ///< the default of the XML encoding
  NodeTreatment treatment = NodeTreatment::kept;
  /// drawn: what of it, where that is not all. converted: the node that is written. kept: the reason, "" where nothing
  /// is to be seen or heard of the node in any program. dropped: the reason.
  std::string_view note;
};

/// The nodes of X3D 4.0 in the order of their names, then those of other programs, then the statements, which are no
/// nodes (ROUTE, IMPORT, head, field …).
std::span<const NodeRow> nodeTable();

/// The row of an element; null for the name of no row.
const NodeRow* nodeRow(std::string_view element);

/// "drawn", "converted", "kept" or "dropped".
std::string_view nameOf(NodeTreatment treatment);

} // namespace imgeo::x3d
