#pragma once
// Reads the references of patches to the files of their indices and vertices (docs/formats/nodes.md, "References").

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

#include <cstdint>
#include <optional>
#include <string>

namespace imgeo {

/// Parses a reference: url or url#N in classic and compact; url, url+S, url?+S, url#O or url#O+S in BG, with the byte
/// offset O and the stride S. Throws Error{malformed}.
Reference referenceOf(const FieldReader& fields, const std::string& url, Encoding encoding);

/// Why the coordinates or indices of one patch are in no file: they are a live stream, a movie or a canvas. Nothing
/// where files may hold them.
std::optional<std::string> reasonImagesAreNotInFiles(const DocumentText& source, const pugi::xml_node& patch);

/// Sets the references of a patch of classic or BG, which the fields of `node` have or, in classic, its children that
/// hold images, X3DOM's form. An image beyond those that an attribute can have, or one of an attribute that cannot be
/// read, is left out with a warning or, without `warnings`, an Error{malformed}. Throws Error for an image of
/// coordinates or indices that cannot be read.
void readPatchReferences(const DocumentText& source, const pugi::xml_node& node, Encoding encoding,
                         DocumentWarnings* warnings, PatchDescription& patch);

/// The field `patch` of a Shape, "DEF#N".
struct PatchName {
  std::string geometry; ///< the DEF of the geometry node
  std::uint32_t index = 0;
};

/// Empty for text of another form.
std::optional<PatchName> parsePatchName(const std::string& text);

} // namespace imgeo
