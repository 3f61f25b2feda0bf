#pragma once
// Answers requests below /live/, without sockets: docs/live.md, "Requests".

#include "live/streams.h"
#include "serve/respond.h"

#include <variant>

namespace imgeo {

/// The request cannot be answered before the stream changes.
struct WaitForChange {
  std::shared_ptr<live::Stream> stream;
  std::uint64_t version = 0; ///< of the state that was looked at
};

/// The response has no end: an image of each frame that the viewer has time for.
struct ImageSequence {
  std::shared_ptr<live::Stream> stream;
};

/// The request publishes: its body has to be read, and given to publish().
struct Publication {
  std::string stream;
  std::size_t maxBytes = 0; ///< of the body
};

using LiveReply = std::variant<Response, WaitForChange, ImageSequence, Publication>;

/// Whether a request target is below /live/.
bool isLiveTarget(std::string_view target);

/// Answers a request whose target is below /live/. Safe for untrusted requests and from several threads.
LiveReply replyToLive(live::Streams& streams, const RequestHead& request);

/// The answer to a viewer who has waited too long.
Response answerAfterWaiting(const live::Stream& stream);

/// Answers a POST: announces an epoch (application/json) or adds a frame. Safe for untrusted bodies.
Response publish(live::Streams& streams, const Publication& publication, std::string_view contentType, Bytes body);

} // namespace imgeo
