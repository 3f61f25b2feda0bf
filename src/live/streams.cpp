#include "live/streams.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo::live {

namespace {

constexpr auto idleTime = std::chrono::minutes(1);

} // namespace

std::shared_ptr<Stream> Streams::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(name);
  return found == streams_.end() ? nullptr : found->second;
}

std::shared_ptr<Stream> Streams::open(const std::string& name) {
  if (!isStreamName(name))
    throw Error(ErrorKind::malformed, name, "is no name of a stream: it has 1 to 64 of a-z A-Z 0-9 _ -");
  const std::lock_guard lock(mutex_);
  if (const auto found = streams_.find(name); found != streams_.end())
    return found->second;
  if (streams_.size() >= limits_.streams) {
    const auto idle =
        std::ranges::min_element(streams_, {}, [](const auto& entry) { return entry.second->lastChange(); });
    if (idle == streams_.end() || std::chrono::steady_clock::now() - idle->second->lastChange() < idleTime)
      throw Error(ErrorKind::limit, name, fmt::format("is one stream too many: there are {}", streams_.size()));
    streams_.erase(idle);
  }
  const auto stream = std::make_shared<Stream>(name, limits_.history, firstNumberNow(), limits_.rate);
  if (run_)
    stream->setRunner(run_);
  streams_.emplace(name, stream);
  return stream;
}

void Streams::setRunner(std::function<void(std::vector<std::function<void()>>)> run) {
  const std::lock_guard lock(mutex_);
  run_ = std::move(run);
  for (const auto& [name, stream] : streams_)
    stream->setRunner(run_);
}

bool areEqualTokens(std::string_view a, std::string_view b) {
  if (a.size() != b.size())
    return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

} // namespace imgeo::live
