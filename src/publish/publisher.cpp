#include "publish/destination.h"
#include "publish/server.h"

#include <chrono>
#include <cmath>
#include <mutex>

namespace imgeo::live {

namespace {

Description descriptionOf(const PublisherOptions& options) {
  Description description;
  FrameLayout& layout = description.layout;
  layout.vertices = options.topology.vertices;
  layout.columns = options.topology.columns;
  layout.positionBits = options.bits;
  layout.normalBits = options.normals;
  layout.colorComponents = options.colors;
  layout.valueComponents = static_cast<std::uint32_t>(options.values.size());
  layout.valueBits = options.values.empty() ? 0 : options.valueBits;
  const auto pointOf = [](const std::array<double, 3>& point) { return Vec3d{point[0], point[1], point[2]}; };
  description.box = {pointOf(options.box.min), pointOf(options.box.max)};
  for (const Range& range : options.values)
    description.valueRange.push_back({range.min, range.max});
  description.rate = options.rate;
  description.viewToken = options.viewToken;
  checkDescription(description, options.name);
  return description;
}

double secondsSince1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

} // namespace

struct Publisher::State {
  std::mutex mutex; ///< frames are published one at a time
  std::string name;
  std::optional<Server> server; ///< outlives the destination
  std::unique_ptr<Destination> destination;
  Description description;
};

Publisher::Publisher(const PublisherOptions& options) : state_(std::make_unique<State>()) {
  state_->description = descriptionOf(options);
  state_->name = options.name;
  if (!options.to.empty()) {
    state_->destination = makeRemoteDestination(options.to, options.name, options.token);
  } else {
    ServerOptions server;
    server.host = options.host;
    server.port = options.port;
    server.history = options.history;
    state_->server.emplace(server);
    state_->destination = makeLocalDestination(state_->server->state_->streams->open(options.name),
                                               state_->server->url() + "live/" + options.name);
  }
  state_->destination->beginEpoch(state_->description);
}

Publisher::Publisher(Server& server, const PublisherOptions& options) : state_(std::make_unique<State>()) {
  state_->description = descriptionOf(options);
  state_->name = options.name;
  state_->destination =
      makeLocalDestination(server.state_->streams->open(options.name), server.url() + "live/" + options.name);
  state_->destination->beginEpoch(state_->description);
}

Publisher::~Publisher() = default;

void Publisher::beginEpoch(const PublisherOptions& options) {
  const std::lock_guard lock(state_->mutex);
  state_->description = descriptionOf(options);
  state_->destination->beginEpoch(state_->description);
}

PublishReport Publisher::publish(std::span<const float> positions, std::span<const float> normals,
                                 std::span<const float> colors, std::span<const float> values) {
  return publishAt(secondsSince1970(), positions, normals, colors, values);
}

PublishReport Publisher::publishAt(double seconds, std::span<const float> positions, std::span<const float> normals,
                                   std::span<const float> colors, std::span<const float> values) {
  const std::lock_guard lock(state_->mutex);
  const Arrays arrays{positions, normals, colors, values};
  checkArrays(arrays, state_->description.layout, state_->name);
  if (!std::isfinite(seconds))
    throw Error(ErrorKind::usage, state_->name, "the time of a frame is not finite");
  if (!state_->destination->isDue())
    return {};
  Frame frame;
  const std::uint64_t clamped = quantise(arrays, state_->description, frame);
  frame.time = seconds;
  state_->destination->countClamped(clamped);
  PublishReport report = state_->destination->publish(std::move(frame));
  report.clamped = clamped;
  return report;
}

PublisherTotals Publisher::totals() const {
  const std::lock_guard lock(state_->mutex);
  return state_->destination->totals();
}

std::string Publisher::url() const {
  return state_->destination->url();
}

} // namespace imgeo::live
