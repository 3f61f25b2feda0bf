#pragma once
// The table of glTF's extensions: those of Khronos' registry, and others that files in use name. It says what becomes
// of each. The reader, its warnings and docs/formats/gltf-extensions.md follow it.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace imgeo::gltf {

enum class ExtensionTreatment : std::uint8_t {
  drawn,        ///< the picture is that of the extension
  approximated, ///< the model is drawn without the extension, or with something similar; a warning says so
  refused,      ///< a file that requires the extension is refused; a file that only uses it is drawn with a warning
  metadata,     ///< the picture is the same with and without it; the data is left out
};

enum class ExtensionStatus : std::uint8_t {
  ratified,
  multiVendor, ///< EXT_: by several vendors, not ratified
  draft,       ///< of Khronos, not ratified yet
  archived,    ///< of Khronos, replaced by others
  vendor,      ///< with the prefix of a vendor
};

struct ExtensionRow {
  std::string_view name;
  ExtensionStatus status = ExtensionStatus::ratified;
  ExtensionTreatment treatment = ExtensionTreatment::metadata;
  /// drawn: as what. Otherwise the reason, a clause that warnings give after the name and a colon. "" where there is
  /// nothing to say, for rows without a warning: drawn and metadata.
  std::string_view note;
};

/// All rows: those of Khronos, then those of several vendors, then those of single vendors, each in the order of names.
std::span<const ExtensionRow> extensionTable();

/// The row of an extension; null for a name that is not in the table.
const ExtensionRow* extensionRow(std::string_view name);

std::string_view nameOf(ExtensionTreatment treatment);
std::string_view nameOf(ExtensionStatus status);

} // namespace imgeo::gltf
