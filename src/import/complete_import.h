#pragma once
// What is done with the scene of every format when it has been read.

#include "import/import.h"

namespace imgeo {

/// Sets the mesh's creaseDegrees as the options ask for.
void completeCreases(Mesh& mesh, const ImportOptions& options);

/// Makes names of nodes unique and gives the scene a title. `isYUpInMetres`: the format states the axes and the unit.
/// Throws Error{malformed} for an incomplete scene without elements, {limit} for one of too many instances of shapes.
void completeImport(Imported& imported, bool isYUpInMetres, const ImportOptions& options, const std::string& name);

} // namespace imgeo
