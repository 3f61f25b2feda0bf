#pragma once
// The elements of interpolators and routes.

#include "documents/element_writer.h"
#include "documents/field_reader.h"
#include "scene/animation.h"

#include <optional>

namespace imgeo {

/// `names`: its DEF, if any.
Element interpolatorElement(const Interpolator& interpolator, const Attributes& names);

Element routeElement(const Route& route, const std::string& fromName, const std::string& toName);

/// Reads a MovieTexture that has the coordinates of an ImageGeometry: a lossless video, and the index of the same
/// frames as a sequence. Nothing for any other element.
std::optional<Interpolator> readMovie(const FieldReader& fields);

/// Reads an interpolator, which may be malformed: see faultOf.
Interpolator readInterpolator(InterpolatorKind kind, const FieldReader& fields);

} // namespace imgeo
