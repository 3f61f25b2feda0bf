#pragma once
// The streams of one server, and who may publish them.

#include "live/stream.h"

#include <map>

namespace imgeo::live {

struct StreamLimits {
  std::size_t streams = 16;                       ///< at a time
  std::size_t frameBytes = std::size_t{16} << 20; ///< of an encoded frame that is posted
  HistoryLimits history;
  double rate = 0;          ///< frames per second of a stream, whatever it announces; 0: no limit
  unsigned framesAhead = 8; ///< a request for a frame waits if it is at most so far ahead of the newest
  unsigned waitMs = 10'000; ///< how long
  std::string publishToken; ///< that POST and DELETE state; empty: nobody may publish by HTTP
  std::string viewToken;    ///< that viewers state for streams without a token of their own; empty: everybody may view
};

/// Safe to use from several threads.
class Streams {
public:
  explicit Streams(StreamLimits limits) : limits_(std::move(limits)) {}

  const StreamLimits& limits() const { return limits_; }

  /// nullptr if there is no stream of this name.
  std::shared_ptr<Stream> find(const std::string& name) const;

  /// The stream of this name, a new one if there is none. Where there are too many, one that has not changed for a
  /// minute makes room. Throws Error{malformed} for an invalid name and Error{limit} if there is no room.
  std::shared_ptr<Stream> open(const std::string& name);

  /// The runner of every stream (Stream::setRunner).
  void setRunner(std::function<void(std::vector<std::function<void()>>)> run);

private:
  const StreamLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Stream>> streams_;
  std::function<void(std::vector<std::function<void()>>)> run_;
};

/// Whether two tokens are equal. The time that this takes does not tell where tokens of equal length differ.
bool areEqualTokens(std::string_view a, std::string_view b);

} // namespace imgeo::live
