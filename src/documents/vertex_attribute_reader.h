#pragma once
// FloatVertexAttribute elements, and what patches hold of them.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

namespace imgeo {

/// The FloatVertexAttribute children of a geometry node. Throws Error{malformed}.
std::vector<AttributeDescription> readVertexAttributes(const DocumentText& source, const pugi::xml_node& node,
                                                       Encoding encoding);

/// A patch's references, which stand one attribute after the other, by attribute. Throws
/// Error{malformed} where there are more or fewer than the attributes have files.
std::vector<std::vector<Reference>> referencesByAttribute(const FieldReader& fields,
                                                          const std::vector<Reference>& references,
                                                          const std::vector<AttributeDescription>& attributes,
                                                          Encoding encoding);

} // namespace imgeo
