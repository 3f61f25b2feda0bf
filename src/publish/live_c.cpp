#include "imgeo/live_c.h"

#include "base/error.h"
#include "imgeo/live.h"

#include <cmath>
#include <memory>
#include <mutex>

namespace {

using imgeo::live::Publisher;
using imgeo::live::PublisherOptions;

thread_local std::string lastFailure;

/// Calls `body` and returns 0, or the code of the exception that it throws.
template <typename Body> int guarded(const Body& body) noexcept {
  try {
    lastFailure.clear();
    body();
    return 0;
  } catch (const imgeo::Error& error) {
    lastFailure = error.what();
    return imgeo::exitCode(error.kind());
  } catch (const std::exception& error) {
    lastFailure = error.what();
    return 4;
  }
}

} // namespace

struct imgeo_publisher {
  mutable std::mutex mutex;
  PublisherOptions options;
  bool isChanged = false; ///< options are newer than the publisher's epoch
  std::unique_ptr<Publisher> publisher;
  std::string url;

  void setTopology(std::uint32_t vertices, std::uint32_t columns, const double box[6]) {
    options.topology = {vertices, columns};
    options.box = {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  }

  /// Changes an option.
  template <typename Change> int set(const Change& change) noexcept {
    return guarded([&] {
      const std::lock_guard lock(mutex);
      change();
      isChanged = true;
    });
  }

  void start() {
    publisher = nullptr; // frees its port first
    publisher = std::make_unique<Publisher>(options);
    url = publisher->url();
    isChanged = false;
  }
};

extern "C" {

imgeo_publisher* imgeo_publisher_create(const char* name, uint32_t vertices, uint32_t columns, const double box[6]) {
  std::unique_ptr<imgeo_publisher> publisher;
  const int failure = guarded([&] {
    publisher = std::make_unique<imgeo_publisher>();
    publisher->options.name = name;
    publisher->setTopology(vertices, columns, box);
  });
  return failure == 0 ? publisher.release() : nullptr;
}

void imgeo_publisher_destroy(imgeo_publisher* publisher) {
  delete publisher;
}

int imgeo_publisher_set_topology(imgeo_publisher* publisher, uint32_t vertices, uint32_t columns, const double box[6]) {
  return publisher->set([&] { publisher->setTopology(vertices, columns, box); });
}

int imgeo_publisher_set_bits(imgeo_publisher* publisher, uint32_t bits) {
  return publisher->set([&] { publisher->options.bits = bits; });
}

int imgeo_publisher_set_normals(imgeo_publisher* publisher, uint32_t bits) {
  return publisher->set([&] { publisher->options.normals = bits; });
}

int imgeo_publisher_set_colors(imgeo_publisher* publisher, uint32_t components) {
  return publisher->set([&] { publisher->options.colors = components; });
}

int imgeo_publisher_set_values(imgeo_publisher* publisher, uint32_t components, const double* ranges, uint32_t bits) {
  return publisher->set([&] {
    publisher->options.values.clear();
    for (std::size_t i = 0; i < components; ++i)
      publisher->options.values.push_back({ranges[2 * i], ranges[2 * i + 1]});
    publisher->options.valueBits = bits;
  });
}

int imgeo_publisher_set_rate(imgeo_publisher* publisher, double rate) {
  return publisher->set([&] { publisher->options.rate = rate; });
}

int imgeo_publisher_set_view_token(imgeo_publisher* publisher, const char* token) {
  return publisher->set([&] { publisher->options.viewToken = token ? token : ""; });
}

int imgeo_publisher_listen(imgeo_publisher* publisher, const char* host, uint16_t port) {
  return guarded([&] {
    const std::lock_guard lock(publisher->mutex);
    publisher->options.host = host;
    publisher->options.port = port;
    publisher->options.to.clear();
    publisher->start();
  });
}

int imgeo_publisher_connect(imgeo_publisher* publisher, const char* server, const char* token) {
  return guarded([&] {
    const std::lock_guard lock(publisher->mutex);
    publisher->options.to = server;
    publisher->options.token = token ? token : "";
    publisher->start();
  });
}

int imgeo_publisher_publish(imgeo_publisher* publisher, double time, const float* positions, const float* normals,
                            const float* colors, const float* values) {
  return guarded([&] {
    const std::lock_guard lock(publisher->mutex);
    if (!publisher->publisher)
      throw imgeo::Error(imgeo::ErrorKind::usage, publisher->options.name, "is published nowhere yet");
    if (publisher->isChanged)
      publisher->publisher->beginEpoch(publisher->options);
    publisher->isChanged = false;
    const PublisherOptions& options = publisher->options;
    const std::size_t vertices = options.topology.vertices;
    const auto arrayOf = [vertices](const float* array, std::size_t components) {
      return std::span<const float>(array, array ? vertices * components : 0);
    };
    const auto p = arrayOf(positions, 3), n = arrayOf(normals, 3), c = arrayOf(colors, options.colors),
               v = arrayOf(values, options.values.size());
    if (std::isnan(time))
      publisher->publisher->publish(p, n, c, v);
    else
      publisher->publisher->publishAt(time, p, n, c, v);
  });
}

imgeo_totals imgeo_publisher_totals(const imgeo_publisher* publisher) {
  const std::lock_guard lock(publisher->mutex);
  if (!publisher->publisher)
    return {};
  const imgeo::live::PublisherTotals totals = publisher->publisher->totals();
  return {totals.published, totals.dropped, totals.clamped, totals.bytes};
}

const char* imgeo_publisher_url(const imgeo_publisher* publisher) {
  return publisher->url.c_str();
}

const char* imgeo_publisher_error(void) {
  return lastFailure.c_str();
}

} // extern "C"
