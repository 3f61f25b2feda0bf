#pragma once
// Reads FloatVertexAttribute elements and the references of patches to their values.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

namespace imgeo {

/// The FloatVertexAttribute children of a geometry node. Throws Error{malformed}.
std::vector<AttributeDescription> readVertexAttributes(const DocumentText& source, const pugi::xml_node& node,
                                                       Encoding encoding);

/// Groups the references in a patch's field `attrib`, which are listed one attribute after the other, by attribute.
/// Throws Error{malformed} if there are more or fewer of them than the attributes have files.
std::vector<std::vector<Reference>> referencesByAttribute(const FieldReader& fields,
                                                          const std::vector<Reference>& references,
                                                          const std::vector<AttributeDescription>& attributes,
                                                          Encoding encoding);

} // namespace imgeo
