#pragma once
// The frames of a sequence before they are encoded: a mesh for each moment, all with the elements of the first.

#include "scene/mesh.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace imgeo {

/// Meshes that follow one another at a constant rate.
class FrameSource {
public:
  virtual ~FrameSource() = default;

  /// At least one.
  virtual std::size_t count() const = 0;

  /// The mesh of a frame; its vertices are its wedges. All frames have the wedges, the elements and the attributes of
  /// the first one; positions, normals, colours and the values of further attributes differ. Safe to call from any
  /// thread. Throws Error for a frame that cannot be read or is another mesh.
  virtual Mesh read(std::size_t frame) const = 0;
};

/// What frames have in common.
struct FrameSurvey {
  Box3d box;               ///< of the positions of all frames
  bool hasNormals = false; ///< the source has them
  bool colorsMove = false; ///< colours differ from frame to frame
  std::string valueName;   ///< of the further attribute whose values differ from frame to frame; empty: none
  std::vector<std::array<double, 2>> valueRange; ///< of each of its components, minimum and maximum
};

/// Reads all frames, several at a time, and calls done() after each. Throws Error{unsupported} with `location` where
/// more than one further attribute changes.
FrameSurvey survey(const FrameSource& frames, const std::string& location, const std::function<void()>& done);

/// The further attribute that keeps the number of each vertex of a source until it has been encoded.
inline constexpr const char* sourceVertexName = "imgeo:source vertex";

/// Gives the wedges of a mesh their numbers as a further attribute, so that none of them are merged, and no crease
/// angle that would divide them. Throws Error{limit} for more than live::maxFrameVertices.
void numberVertices(Mesh& mesh);

/// Removes that attribute and returns the numbers.
std::vector<std::uint32_t> takeVertexNumbers(VertexAttributes& vertices);

} // namespace imgeo
