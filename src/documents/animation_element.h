#pragma once
// The elements of interpolators and routes.

#include "documents/element_writer.h"
#include "documents/field_reader.h"
#include "scene/animation.h"

namespace imgeo {

/// `names`: its DEF, if any.
Element interpolatorElement(const Interpolator& interpolator, const Attributes& names);

Element routeElement(const Route& route, const std::string& fromName, const std::string& toName);

/// Reads an interpolator, which may be malformed: see faultOf.
Interpolator readInterpolator(InterpolatorKind kind, const FieldReader& fields);

} // namespace imgeo
