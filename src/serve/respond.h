#pragma once
// Makes the response to a request head, without sockets.
// RFC 9110 (HTTP semantics), RFC 9111 (caching).

#include "serve/coding_cache.h"
#include "serve/open_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

/// The parts of a request that its response depends on; absent header fields are empty.
struct RequestHead {
  std::string_view method, target;
  std::string_view acceptEncoding, ifNoneMatch, ifRange, range;
  std::string_view authorization;
  bool isFromCache = false; ///< a proxy or a content delivery network sends it: Via or CDN-Loop is there
};

struct Response {
  unsigned status = 200;
  std::vector<std::pair<std::string_view, std::string>> fields; ///< Content-Length among them
  // The body: bytes in memory, or a range of a file; neither for HEAD and 304.
  std::shared_ptr<const Bytes> content;
  std::shared_ptr<const OpenFile> file;
  std::uint64_t fileFirst = 0, fileCount = 0;

  /// The value of a field; empty where it is absent.
  std::string_view field(std::string_view name) const;
  /// Replaces the value of a field, or adds it.
  void setField(std::string_view name, std::string value);
};

/// The served directory, shared by all responses.
struct Site {
  std::filesystem::path root; ///< canonical; empty: there are no files
  CodingCache& codings;
};

/// Answers a request, an invalid one with a 4xx status. Throws Error{io} where an opened file cannot be read. Safe for
/// untrusted requests and from several threads.
Response respond(const Site& site, const RequestHead& request);

/// A response whose body is one sentence of plain text.
Response plainResponse(unsigned status, std::string_view sentence);

/// Whether an If-None-Match header names this ETag (with its quotes), by weak comparison.
bool matchesAnyTag(std::string_view ifNoneMatch, std::string_view tag);

} // namespace imgeo
