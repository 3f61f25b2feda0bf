#pragma once
// The geometries of an X3D document whose vertices interpolators move, and which become meshes with frames.

#include "import/import.h"
#include "import/x3d/source.h"
#include "scene/animation.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// The interpolators of a geometry.
struct MovingVertices {
  std::string coordinateDef, normalDef; ///< DEFs of the interpolators; normalDef may be empty
  Interpolator coordinates;
  Interpolator normals; ///< without keys where normalDef is empty
};

class Recordings {
public:
  /// `source` must outlive this.
  Recordings(const Source& source, const RecordingChoice& choice);

  /// The interpolators of a geometry that is to become a mesh with frames. Empty where nothing moves its coordinates,
  /// where their text stays in the document, and where routes connect more of it than its coordinates and normals.
  std::optional<MovingVertices> of(pugi::xml_node geometry) const;

private:
  struct End {
    std::string node, field; ///< without set_ and _changed
  };
  struct Connection {
    End from, to;
  };

  bool isChosen(const Connection& connection, const Interpolator& interpolator, std::size_t textBytes) const;
  double secondsOf(const std::string& interpolator, const std::vector<float>& keys) const;

  const Source& source_;
  RecordingChoice choice_;
  std::vector<Connection> connections_;
  std::set<std::string, std::less<>> exported_; ///< DEFs that other documents may connect
};

} // namespace imgeo::x3d
