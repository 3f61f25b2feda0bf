#pragma once
// Expands prototype instances into the nodes of the prototypes' bodies.

#include "import/x3d/elements.h"
#include "import/x3d/extern_prototypes.h"
#include "import/x3d/prototype_report.h"

#include <string>

namespace imgeo::x3d {

/// Replaces each instance by a copy of the first node of its prototype's body, the only node that is rendered (ISO/IEC
/// 19775-1, 4.4.4.3), with the field values of the instance, and removes the declarations. Copies of the body's further
/// nodes that only send events, and of its routes, go to the end of the scene; routes to a field of an instance become
/// routes to the fields that it stands for. `externals` reads the files of external prototypes. Safe for untrusted
/// documents: throws Error{limit} naming `name` where nested prototypes expand to too many elements.
PrototypeReport expandPrototypes(Elements& elements, const std::string& name, ExternPrototypes& externals);

} // namespace imgeo::x3d
