#pragma once
// What the Inlines of one X3D document lead to.

#include "import/references.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// How deep documents may inline one another, and how many of them there may be in all.
inline constexpr std::size_t maxInlineDepth = 16, maxInlinedDocuments = 1000;

class Inlines {
public:
  /// `scene` takes the documents up; `warnings` what there is to say of them.
  Inlines(const References& references, const ImportOptions& options, Scene& scene, std::vector<std::string>& warnings)
      : references_(references), options_(options), scene_(scene), warnings_(warnings) {}

  struct Document {
    std::size_t index = 0;          ///< into SceneGraph::inlined
    std::vector<std::size_t> roots; ///< its top nodes
  };

  /// Reads the file of a relative url, of whatever format, once however often it is
  /// named. Throws what importFile throws, Error{malformed} for a file that inlines
  /// this one, Error{unsupported} for one too deep, Error{limit} for one too many.
  Document read(const std::string& url);

private:
  void requireNoCircle(const std::filesystem::path& file) const;

  const References& references_;
  const ImportOptions& options_;
  Scene& scene_;
  std::vector<std::string>& warnings_;
  std::map<std::filesystem::path, Document> read_;
};

} // namespace imgeo::x3d
