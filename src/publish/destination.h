#pragma once
// Where a publisher sends its frames: a stream in this process, or a server elsewhere.

#include "imgeo/live.h"
#include "live/quantise.h"
#include "live/stream.h"

namespace imgeo::live {

class Destination {
public:
  virtual ~Destination() = default;

  virtual void beginEpoch(const Description& description) = 0;
  /// Whether a frame may come now; counts one that may not.
  virtual bool isDue() = 0;
  /// Takes a frame with layout, time and components; number and epoch are the destination's.
  virtual PublishReport publish(Frame frame) = 0;
  virtual void countClamped(std::uint64_t values) = 0;
  virtual PublisherTotals totals() const = 0;
  virtual std::string url() const = 0;
};

/// A stream of a server in this process. The server outlives the destination.
std::unique_ptr<Destination> makeLocalDestination(std::shared_ptr<Stream> stream, std::string url);

/// A server elsewhere: "http://host:8090". Frames are sent by a thread; where the network is slower than frames come,
/// the newest is sent and others are dropped. Throws Error{usage} for another kind of URL.
std::unique_ptr<Destination> makeRemoteDestination(const std::string& server, const std::string& name,
                                                   const std::string& token);

} // namespace imgeo::live
