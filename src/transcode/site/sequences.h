#pragma once
// The sequences of a site.

#include "live/frame.h"
#include "prepare/primitives.h"
#include "scene/mesh.h"
#include "sequence/sequence_index.h"
#include "transcode/site/site_document.h"

#include <functional>

namespace imgeo {

/// A sequence that moves the vertices of a shape.
struct SiteSequence {
  std::size_t shape = 0; ///< index into SceneGraph::nodes
  std::string url;       ///< of the index
  SequenceIndex index;
  std::string video; ///< a lossless video of the same frames; empty: there is none

  /// The URL of a file of frames, relative to the site.
  std::string urlOf(std::size_t file) const;
};

/// Reads frames `first` .. `end` - 1 of a sequence, from its video if it has one, and calls visit(frame) with each, in
/// their order. Throws Error for a file that cannot be read, and for a video that is not lossless.
void readFrames(const SiteDocument& document, const SiteSequence& sequence, std::uint32_t first, std::uint32_t end,
                const std::function<void(const live::Frame&)>& visit);

/// The same, from the files of frames.
void readFrameFiles(const SiteDocument& document, const SiteSequence& sequence, std::uint32_t first, std::uint32_t end,
                    const std::function<void(const live::Frame&)>& visit);

/// Gives a mesh whose wedges are the vertices of a frame, in their order, the frame's positions, and the normals,
/// colours and values that it has. Without normals in the frame the mesh has none.
void moveVertices(Mesh& mesh, const live::Frame& frame, const SequenceIndex& index);

/// The mesh of a frame: a vertex for each of the static mesh, which `still` is, with the frame's positions and the
/// normals and colours that it has. Without normals in the frame the mesh has none.
Mesh meshOfFrame(const IndexedPatch& still, const live::Frame& frame, const SequenceIndex& index);

/// Reads the indexes of all sequences, in document order. Throws Error for one that cannot be read.
std::vector<SiteSequence> sequencesOf(const SiteDocument& document);

} // namespace imgeo
