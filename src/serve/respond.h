#pragma once
// What a request is answered with. No sockets here: one head in, one answer out.
// RFC 9110 (HTTP semantics), RFC 9111 (caching).

#include "serve/coding_cache.h"
#include "serve/open_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

/// The parts of a request head that matter here; absent fields are empty.
struct RequestHead {
  std::string_view method, target;
  std::string_view acceptEncoding, ifNoneMatch, ifRange, range;
};

struct Response {
  unsigned status = 200;
  std::vector<std::pair<std::string_view, std::string>> fields; ///< Content-Length among them
  // The body: bytes in memory, or else a part of a file; neither for HEAD and 304.
  std::shared_ptr<const Bytes> content;
  std::shared_ptr<const OpenFile> file;
  std::uint64_t fileFirst = 0, fileCount = 0;

  /// The value of a field, or nothing.
  std::string_view field(std::string_view name) const;
};

/// What answers share.
struct Site {
  std::filesystem::path root; ///< canonical
  CodingCache& codings;
};

/// Answers a request; bad ones with the status that says why. Throws Error{io} only
/// if an opened file cannot be read. Safe for untrusted requests and from several threads.
Response respond(const Site& site, const RequestHead& request);

/// An answer of one plain sentence.
Response refuse(unsigned status, std::string_view sentence);

/// Whether an If-None-Match header names this ETag (with its quotes), by the weak comparison.
bool matchesAnyTag(std::string_view ifNoneMatch, std::string_view tag);

} // namespace imgeo
