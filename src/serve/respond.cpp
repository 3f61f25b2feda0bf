#include "serve/respond.h"

#include "base/file.h"
#include "content/media_type.h"
#include "serve/range_header.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

// Compressing larger files for a request would block a thread for too long.
constexpr std::uint64_t maxEncodedBytes = 16u << 20;

constexpr std::string_view indexName = "index.html";
/// WebAssembly, which workers decode with, has to be allowed by name.
constexpr std::string_view contentPolicy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'";

/// Whether a file of this path never changes: its name, or its folder in "geometry" as that of a mesh with levels of
/// detail ("geometry/9f3c0123456789ab/0/7.png"), is a hash of the content.
bool isImmutable(const std::vector<std::string>& names) {
  if (names.empty())
    return false;
  for (std::size_t i = 1; i + 1 < names.size(); ++i)
    if (names[i - 1] == "geometry" && names[i].find('.') == std::string::npos && isContentNamed(names[i]))
      return true;
  return isContentNamed(names.back());
}

/// The fields that 200 and 304 share (RFC 9110, section 15.4.5).
void addCacheFields(Response& response, bool immutable, const std::string& tag, bool varies) {
  response.fields.emplace_back("ETag", tag);
  response.fields.emplace_back("Cache-Control", immutable ? "public, max-age=31536000, immutable" : "no-cache");
  if (varies)
    response.fields.emplace_back("Vary", "Accept-Encoding");
}

void addContentFields(Response& response, const MediaType& type, std::uint64_t bytes) {
  response.fields.emplace_back("Content-Type", type.name);
  response.fields.emplace_back("Content-Length", std::to_string(bytes));
  response.fields.emplace_back("X-Content-Type-Options", "nosniff");
  response.fields.emplace_back("Content-Security-Policy", contentPolicy);
}

Response redirectTo(const std::string& location) {
  Response response = plainResponse(301, "This is a directory.");
  response.fields.emplace_back("Location", location);
  return response;
}

Bytes readAll(const OpenFile& file) {
  Bytes bytes(file.size());
  bytes.resize(file.readAt(0, bytes));
  return bytes;
}

/// Sends the whole file, compressed.
void sendEncoded(Response& response, const Site& site, const OpenFile& file, const std::string& tag,
                 const MediaType& type, ContentCoding coding) {
  response.content = site.codings.get(tag, [&] { return encodeContent(coding, readAll(file)); });
  addContentFields(response, type, response.content->size());
  response.fields.emplace_back("Content-Encoding", codingName(coding));
}

/// Sends the file's own bytes, or the range of them.
void sendPlain(Response& response, std::shared_ptr<const OpenFile> file, const MediaType& type, ByteRange range) {
  response.fileFirst = range.first;
  response.fileCount = range.count;
  response.fields.emplace_back("Accept-Ranges", "bytes");
  if (range.kind == ByteRange::Kind::partial) {
    response.status = 206;
    response.fields.emplace_back(
        "Content-Range", fmt::format("bytes {}-{}/{}", range.first, range.first + range.count - 1, file->size()));
  }
  addContentFields(response, type, range.count);
  response.file = std::move(file);
}

/// The file beside the requested one that holds its content in this coding (convert --precompress); nullptr if there is
/// none or it is older than the content, which somebody has then edited.
std::shared_ptr<const OpenFile> openPrecompressed(const Site& site, RequestPath path, const OpenFile& file,
                                                  ContentCoding coding) {
  if (path.isDirectory)
    path.names.emplace_back(indexName);
  path.isDirectory = false;
  path.names.back() += codingExtension(coding);
  auto found = openBelow(site.root, path);
  const auto* encoded = std::get_if<std::shared_ptr<const OpenFile>>(&found);
  return encoded && (*encoded)->modifiedNanoseconds() >= file.modifiedNanoseconds() ? *encoded : nullptr;
}

Response respondWithFile(const Site& site, const RequestHead& request, const RequestPath& path,
                         std::shared_ptr<const OpenFile> file) {
  const std::string_view fileName = path.isDirectory ? indexName : std::string_view(path.names.back());
  const MediaType type = mediaTypeOf(fileName);
  const bool varies = type.isCompressible && file->size() >= minEncodedBytes;
  // Ranges count uncompressed bytes, so a range request gets no coding.
  ContentCoding coding =
      varies && request.range.empty() ? chooseCoding(request.acceptEncoding) : ContentCoding::identity;
  std::shared_ptr<const OpenFile> precompressed;
  if (coding != ContentCoding::identity)
    precompressed = openPrecompressed(site, path, *file, coding);
  if (!precompressed && file->size() > maxEncodedBytes)
    coding = ContentCoding::identity;
  const std::string suffix = coding == ContentCoding::identity ? "" : fmt::format("-{}", codingName(coding));
  const std::string tag = fmt::format("\"{}{}\"", (precompressed ? precompressed : file)->version(), suffix);

  Response response;
  addCacheFields(response, !path.isDirectory && isImmutable(path.names), tag, varies);
  if (matchesAnyTag(request.ifNoneMatch, tag)) {
    response.status = 304;
    return response;
  }
  if (precompressed) {
    addContentFields(response, type, precompressed->size());
    response.fields.emplace_back("Content-Encoding", codingName(coding));
    response.fileCount = precompressed->size();
    response.file = std::move(precompressed);
    return response;
  }
  if (coding != ContentCoding::identity) {
    sendEncoded(response, site, *file, tag, type, coding);
    return response;
  }
  // If-Range with another tag, or with a date (this server sends no Last-Modified): the whole file.
  const bool hasRange =
      request.method == "GET" && !request.range.empty() && (request.ifRange.empty() || request.ifRange == tag);
  const ByteRange range = parseRange(hasRange ? request.range : "", file->size());
  if (range.kind == ByteRange::Kind::unsatisfiable) {
    Response refusal = plainResponse(416, "The file ends before the range begins.");
    refusal.fields.emplace_back("Content-Range", fmt::format("bytes */{}", file->size()));
    return refusal;
  }
  sendPlain(response, std::move(file), type, range);
  return response;
}

/// The answer where there is no file: 404. Browsers ask for /favicon.ico where a page names no icon, as pages of live
/// streams and those of `convert --no-pictures` do, and report a 404 as an error: 204 means that there is none.
Response absentFile(const RequestPath& path) {
  if (formatRequestPath(path) != "/favicon.ico")
    return plainResponse(404, "There is no such file.");
  Response response;
  response.status = 204;
  response.fields.emplace_back("Cache-Control", "no-cache");
  response.fields.emplace_back("Content-Length", "0");
  return response;
}

Response respondToGet(const Site& site, const RequestHead& request) {
  const std::optional<RequestPath> path = parseRequestTarget(request.target);
  if (!path)
    return plainResponse(400, "The path is malformed.");
  if (site.root.empty())
    return absentFile(*path);
  auto found = openBelow(site.root, *path);
  if (const Absence* absence = std::get_if<Absence>(&found)) {
    if (*absence == Absence::notFound)
      return absentFile(*path);
    // Made from the decoded names: a target such as "//host" must not become a link to another host.
    return redirectTo(formatRequestPath({path->names, true}));
  }
  return respondWithFile(site, request, *path, std::get<std::shared_ptr<const OpenFile>>(std::move(found)));
}

} // namespace

std::string_view Response::field(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
  return found == fields.end() ? std::string_view() : std::string_view(found->second);
}

void Response::setField(std::string_view name, std::string value) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
  if (found == fields.end())
    fields.emplace_back(name, std::move(value));
  else
    found->second = std::move(value);
}

Response plainResponse(unsigned status, std::string_view sentence) {
  Response response;
  response.status = status;
  const std::string text = fmt::format("{}\n", sentence);
  response.content = std::make_shared<const Bytes>(text.begin(), text.end());
  response.fields.emplace_back("Cache-Control", "no-cache");
  addContentFields(response, mediaTypeOf("refusal.txt"), response.content->size());
  return response;
}

bool matchesAnyTag(std::string_view ifNoneMatch, std::string_view tag) {
  while (!ifNoneMatch.empty()) {
    const std::size_t first = ifNoneMatch.find_first_not_of(" \t,");
    if (first == std::string_view::npos)
      return false;
    ifNoneMatch.remove_prefix(first);
    if (ifNoneMatch.front() == '*')
      return true;
    if (ifNoneMatch.starts_with("W/"))
      ifNoneMatch.remove_prefix(2);
    // This server's tags hold no comma, so cutting at one cannot cut a tag that matches.
    const std::size_t end = std::min(ifNoneMatch.find_first_of(", \t"), ifNoneMatch.size());
    if (ifNoneMatch.substr(0, end) == tag)
      return true;
    ifNoneMatch.remove_prefix(end);
  }
  return false;
}

Response respond(const Site& site, const RequestHead& request) {
  const bool isHead = request.method == "HEAD";
  if (!isHead && request.method != "GET") {
    Response response = plainResponse(405, "Only GET and HEAD are answered here.");
    response.fields.emplace_back("Allow", "GET, HEAD");
    return response;
  }
  Response response = respondToGet(site, request);
  if (isHead) {
    response.content.reset();
    response.file.reset();
  }
  return response;
}

} // namespace imgeo
