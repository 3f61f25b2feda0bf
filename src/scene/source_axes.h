#pragma once
// The Transform at the top of a document that brings its source upright and to metres.

#include "imgeo/source_axes.h"
#include "scene/scene.h"

namespace imgeo {

/// The map from source to document coordinates.
Affine3d documentFromSource(const SourceAxes& axes);

/// Puts the nodes of a scene below one Transform; does nothing if `axes` change nothing. Declarations, routes and
/// layers of X3D sources stay at the top, where the standard wants them.
void applySourceAxes(SceneGraph& graph, const SourceAxes& axes);

/// Puts the nodes of a document below a Transform that undoes applySourceAxes.
void undoSourceAxes(SceneGraph& graph, const SourceAxes& axes);

} // namespace imgeo
