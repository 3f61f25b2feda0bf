#pragma once
// Reads the files that the Inlines of one X3D document name.

#include "import/references.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// Limits of the nesting depth and of the total number of inlined documents.
inline constexpr std::size_t maxInlineDepth = 16, maxInlinedDocuments = 1000;

class Inlines {
public:
  /// Documents are added to `scene`, their warnings to `warnings`.
  Inlines(const References& references, const ImportOptions& options, Scene& scene, std::vector<std::string>& warnings)
      : references_(references), options_(options), scene_(scene), warnings_(warnings) {}

  struct Document {
    std::size_t index = 0;          ///< into SceneGraph::inlined
    std::vector<std::size_t> roots; ///< its root nodes
  };

  /// Reads the file that a relative URL names, of any format; each file once. Throws what importFile throws,
  /// Error{malformed} for a file that inlines this one, Error{unsupported} beyond the maximum depth, Error{limit}
  /// beyond the maximum number.
  Document read(const std::string& url);

private:
  void requireNoCycle(const std::filesystem::path& file) const;

  const References& references_;
  const ImportOptions& options_;
  Scene& scene_;
  std::vector<std::string>& warnings_;
  std::map<std::filesystem::path, Document> read_;
};

} // namespace imgeo::x3d
