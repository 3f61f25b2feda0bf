#include "serve/live_requests.h"

#include "base/error.h"
#include "serve/request_path.h"

#include <charconv>
#include <fmt/format.h>

namespace imgeo {

namespace {

using live::Stream;

constexpr std::string_view frameType = "application/x-imgeo-frame";

/// The fields of every response: pages of all origins may read it, and its time.
void addCommonFields(Response& response, const Stream* stream) {
  response.fields.emplace_back("Access-Control-Allow-Origin", "*");
  response.fields.emplace_back("Access-Control-Expose-Headers",
                               "Imgeo-Newest, Imgeo-Next, Imgeo-Epoch, Imgeo-Added, Retry-After");
  response.fields.emplace_back("Timing-Allow-Origin", "*");
  if (!stream)
    return;
  const Stream::State state = stream->state();
  if (state.newest)
    response.fields.emplace_back("Imgeo-Newest", std::to_string(state.newest->number()));
  response.fields.emplace_back("Imgeo-Next", std::to_string(state.next));
}

Response refuse(unsigned status, std::string_view sentence, const Stream* stream) {
  Response response = plainResponse(status, sentence);
  response.setField("Cache-Control", "no-store");
  addCommonFields(response, stream);
  return response;
}

Response contentResponse(std::string_view type, std::shared_ptr<const Bytes> content, std::string_view caching,
                         const Stream* stream) {
  Response response;
  response.fields.emplace_back("Content-Type", type);
  response.fields.emplace_back("Content-Length", std::to_string(content->size()));
  response.fields.emplace_back("Cache-Control", caching);
  response.fields.emplace_back("X-Content-Type-Options", "nosniff");
  response.content = std::move(content);
  addCommonFields(response, stream);
  return response;
}

Response jsonResponse(const std::string& json, const Stream* stream) {
  return contentResponse("application/json", std::make_shared<const Bytes>(json.begin(), json.end()), "no-store",
                         stream);
}

/// A decimal number without leading zeros; nothing otherwise.
std::optional<std::uint64_t> numberOf(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool isWhole = failure == std::errc() && end == text.data() + text.size();
  return isWhole && number <= live::maxFrameNumber && (text.size() == 1 || text.front() != '0') ? std::optional(number)
                                                                                                : std::nullopt;
}

/// Leads a viewer who is late to the newest frame. An error instead of this would be a line on a browser's console.
Response redirectToFrame(std::uint64_t number, std::string_view query, const Stream& stream) {
  Response response = refuse(307, "The frame is no longer in the history.", &stream);
  response.fields.emplace_back("Location", fmt::format("{}{}", number, query));
  return response;
}

/// `query`: of the request. `isShared`: whether caches may give the frame to all viewers who ask for the same URL.
LiveReply replyWithFrame(const std::shared_ptr<Stream>& stream, std::uint64_t number, std::string_view query,
                         unsigned framesAhead, bool isShared) {
  // The state comes first: if the frame is added after the look for it, the state is outdated and nobody waits for it.
  const Stream::State state = stream->state();
  if (const auto frame = stream->frame(number)) {
    Response response =
        contentResponse(frameType, frame->bytes(),
                        fmt::format("{}, max-age=31536000, immutable", isShared ? "public" : "private"), stream.get());
    response.fields.emplace_back("Imgeo-Epoch", std::to_string(frame->epoch()));
    response.fields.emplace_back("Imgeo-Added", fmt::format("{:.1f}", frame->addedAt()));
    return response;
  }
  if (number < state.oldest && state.newest)
    return redirectToFrame(state.newest->number(), query, *stream);
  if (number < state.oldest)
    return refuse(410, "The frame is no longer in the history.", stream.get());
  if (state.hasEnded)
    return refuse(404, "The stream has ended.", stream.get());
  if (number >= state.next + framesAhead)
    return refuse(404, "The frame is too far ahead of the newest.", stream.get());
  return WaitForChange{stream, state.version};
}

LiveReply replyWithImage(const std::shared_ptr<Stream>& stream) {
  const Stream::State state = stream->state();
  if (!state.newest)
    return refuse(404, "The stream has no frame yet.", stream.get());
  return contentResponse("image/png", state.newest->image(), "no-store", stream.get());
}

/// What follows the path in a request's target: empty, or `?` and parameters.
std::string_view queryOf(const RequestHead& request) {
  return std::string_view(request.target).substr(std::min(request.target.find('?'), request.target.size()));
}

/// The token that a request states, as `Authorization: Bearer TOKEN` or as `?token=TOKEN` with %XX.
std::string tokenOf(const RequestHead& request) {
  constexpr std::string_view scheme = "Bearer ", parameter = "token=";
  if (request.authorization.starts_with(scheme))
    return std::string(request.authorization.substr(scheme.size()));
  std::string_view query = queryOf(request);
  while (!query.empty()) {
    query.remove_prefix(1);
    const std::size_t end = std::min(query.find('&'), query.size());
    if (query.starts_with(parameter))
      return percentDecode(query.substr(parameter.size(), end - parameter.size())).value_or("");
    query.remove_prefix(end);
  }
  return {};
}

/// The token that viewers of a stream state; empty: everybody may view.
std::string viewTokenOf(const live::Streams& streams, const live::Stream* stream) {
  const auto description = stream ? stream->state().description : nullptr;
  return description && !description->viewToken.empty() ? description->viewToken : streams.limits().viewToken;
}

/// Says why a publisher is refused; nothing if it may publish.
std::optional<Response> refusalOfPublisher(const live::Streams& streams, const RequestHead& request) {
  const std::string& token = streams.limits().publishToken;
  if (token.empty())
    return refuse(403, "This server takes no streams: it was started without a token for publishers.", nullptr);
  if (live::areEqualTokens(token, tokenOf(request)))
    return {};
  Response response = refuse(401, "The token of the publisher is missing or wrong.", nullptr);
  response.fields.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

LiveReply replyToPublisher(live::Streams& streams, const RequestHead& request, const std::string& name) {
  if (auto refusal = refusalOfPublisher(streams, request))
    return *refusal;
  if (!live::isStreamName(name))
    return refuse(404, "A stream's name has 1 to 64 of the characters a-z A-Z 0-9 _ -", nullptr);
  if (request.method == "POST")
    return Publication{name, streams.limits().frameBytes};
  const auto stream = streams.find(name);
  if (!stream)
    return refuse(404, "There is no such stream.", nullptr);
  stream->end();
  return jsonResponse(stream->latest(false), stream.get());
}

/// What browsers ask before a page of another origin may publish.
Response preflightResponse() {
  Response response;
  response.status = 204;
  response.fields.emplace_back("Content-Length", "0");
  response.fields.emplace_back("Access-Control-Allow-Methods", "GET, HEAD, POST, DELETE");
  response.fields.emplace_back("Access-Control-Allow-Headers", "Authorization, Content-Type");
  response.fields.emplace_back("Access-Control-Max-Age", "86400");
  addCommonFields(response, nullptr);
  return response;
}

Response methodRefusal(std::string_view allowed) {
  Response response = refuse(405, "This method is not answered here.", nullptr);
  response.fields.emplace_back("Allow", allowed);
  return response;
}

LiveReply replyToViewer(live::Streams& streams, const std::vector<std::string>& names, const RequestHead& request) {
  const auto stream = streams.find(names[1]);
  const std::string token = viewTokenOf(streams, stream.get());
  if (!token.empty() && !live::areEqualTokens(token, tokenOf(request)))
    return refuse(401, "The token of the viewer is missing or wrong.", nullptr);
  if (!stream)
    return refuse(404, "There is no such stream.", nullptr);
  if (names.size() == 3 && names[2] == "latest")
    return jsonResponse(stream->latest(request.isFromCache), stream.get());
  if (names.size() == 3 && names[2] == "frame.png")
    return replyWithImage(stream);
  if (names.size() == 3 && names[2] == "stream.mpng")
    return ImageSequence{stream};
  const auto number = names.size() == 4 && names[2] == "frames" ? numberOf(names[3]) : std::nullopt;
  if (!number)
    return refuse(404, "There is no such file of a stream.", nullptr);
  // A token in a header is no part of the URL, under which caches keep frames.
  const bool isShared = token.empty() || request.authorization.empty();
  return replyWithFrame(stream, *number, queryOf(request), streams.limits().framesAhead, isShared);
}

Response announce(live::Streams& streams, const std::string& name, ByteSpan body) {
  live::Description description = live::readDescription(asText(body), name);
  const auto stream = streams.open(name);
  stream->beginEpoch(std::move(description));
  return jsonResponse(stream->latest(false), stream.get());
}

Response addFrame(live::Streams& streams, const std::string& name, Bytes body) {
  const auto stream = streams.find(name);
  if (!stream)
    return refuse(404, "The stream has not been announced.", nullptr);
  // Unpacks the frame: viewers must not receive what they would refuse.
  live::decodeFrame(body, name);
  const live::FrameHeader header = live::readFrameHeader(body, name);
  try {
    if (!stream->isDue())
      return refuse(429, "Frames come faster than the stream's rate.", stream.get());
    stream->add(header, std::move(body));
  } catch (const Error& error) {
    return refuse(409, error.what(), stream.get());
  }
  return jsonResponse(fmt::format("{{\"next\": {}}}\n", header.number + 1), stream.get());
}

} // namespace

bool isLiveTarget(std::string_view target) {
  const std::optional<RequestPath> path = parseRequestTarget(target);
  return path && path->names.size() > 1 && path->names[0] == "live";
}

LiveReply replyToLive(live::Streams& streams, const RequestHead& request) {
  const std::optional<RequestPath> path = parseRequestTarget(request.target);
  if (!path || path->names.size() < 2 || path->names.size() > 4 || path->isDirectory)
    return refuse(404, "There is no such stream.", nullptr);
  const bool isStream = path->names.size() == 2;
  if (request.method == "OPTIONS")
    return preflightResponse();
  if (isStream && (request.method == "POST" || request.method == "DELETE"))
    return replyToPublisher(streams, request, path->names[1]);
  if (isStream || (request.method != "GET" && request.method != "HEAD"))
    return methodRefusal(isStream ? "POST, DELETE" : "GET, HEAD");
  LiveReply reply = replyToViewer(streams, path->names, request);
  if (request.method == "HEAD" && std::holds_alternative<ImageSequence>(reply))
    return methodRefusal("GET"); // the images would follow the head
  return reply;
}

Response answerAfterWaiting(const Stream& stream) {
  Response response = refuse(503, "The frame has not been published in time.", &stream);
  response.fields.emplace_back("Retry-After", "1");
  return response;
}

Response publish(live::Streams& streams, const Publication& publication, std::string_view contentType, Bytes body) {
  try {
    if (contentType.starts_with("application/json"))
      return announce(streams, publication.stream, body);
    if (contentType.starts_with(frameType))
      return addFrame(streams, publication.stream, std::move(body));
    return refuse(415, "The content type is neither application/json nor application/x-imgeo-frame.", nullptr);
  } catch (const Error& error) {
    return refuse(error.kind() == ErrorKind::limit ? 413 : 400, error.what(), nullptr);
  }
}

} // namespace imgeo
