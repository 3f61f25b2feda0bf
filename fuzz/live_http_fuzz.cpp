// Requests of publishers and viewers of live streams: method, target, content type and token, one a line, then the
// body. No request may leave a stream in a state in which its newest frame cannot be read.
#include "base/bytes.h"
#include "live/streams.h"
#include "serve/live_requests.h"

#include <algorithm>
#include <cstdlib>
#include <libdeflate.h>

namespace {

using namespace imgeo;

void require(bool condition) {
  if (!condition)
    std::abort();
}

std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

void checkResponse(const Response& response) {
  require(response.status >= 200 && response.status < 600);
  require(!response.field("Content-Length").empty());
  require(response.field("Access-Control-Allow-Origin") == "*");
  for (const auto& [name, value] : response.fields)
    require(value.find_first_of("\r\n") == std::string::npos);
}

/// Streams number their frames from the time at which they begin, which no corpus can know.
void giveNextNumber(const live::Streams& streams, const std::string& name, Bytes& frame) {
  const auto stream = streams.find(name);
  if (!stream || frame.size() < live::frameHeaderBytes)
    return;
  const live::Stream::State state = stream->state();
  Bytes numbers;
  appendLittle(numbers, state.next);
  appendLittle(numbers, state.epoch);
  std::copy(numbers.begin(), numbers.end(), frame.begin() + 8);
  Bytes sum;
  appendLittle(sum, libdeflate_crc32(0, frame.data(), 48));
  std::copy(sum.begin(), sum.end(), frame.begin() + 48);
}

void checkStream(const live::Streams& streams, const std::string& name) {
  const auto stream = streams.find(name);
  if (!stream)
    return;
  require(live::isStreamName(name));
  const live::Stream::State state = stream->state();
  require(state.description != nullptr);
  if (state.newest) {
    require(live::decodeFrame(*state.newest->bytes(), "").number == state.newest->number());
    require(state.next == state.newest->number() + 1);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  live::Streams streams(limits);
  std::string_view text = asText({data, size});
  while (!text.empty()) {
    RequestHead head;
    head.method = takeLine(text);
    head.target = takeLine(text);
    const std::string_view type = takeLine(text);
    head.authorization = takeLine(text);
    const bool isFrame = type.starts_with("application/x-imgeo-frame");
    const std::size_t length = isFrame ? text.size() : std::min<std::size_t>(text.size(), 400);
    const LiveReply reply = replyToLive(streams, head);
    if (const auto* response = std::get_if<Response>(&reply))
      checkResponse(*response);
    if (const auto* publication = std::get_if<Publication>(&reply)) {
      Bytes body(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length));
      text.remove_prefix(length);
      if (isFrame)
        giveNextNumber(streams, publication->stream, body);
      checkResponse(publish(streams, *publication, type, std::move(body)));
      checkStream(streams, publication->stream);
    }
  }
  return 0;
}
