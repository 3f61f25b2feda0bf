#include "imgeo/live.h"
#include "imgeo/live_c.h"
#include "live/quantise.h"
#include "publish/http_client.h"

#include "base/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace imgeo::live {
namespace {

using Json = nlohmann::json;

PublisherOptions gridOptions() {
  PublisherOptions options;
  options.name = "waves";
  options.box = {{-1, -1, -1}, {1, 1, 1}};
  options.topology = Topology::grid(16, 12);
  options.port = 0;
  return options;
}

std::vector<float> waves(float time) {
  std::vector<float> positions;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 16; ++column) {
      const float x = static_cast<float>(column) / 8 - 1, z = static_cast<float>(row) / 8 - 0.75F;
      positions.insert(positions.end(), {x, 0.5F * std::sin(3 * x + time), z});
    }
  return positions;
}

/// The stored integers of positions, computed as docs/live.md says.
std::vector<std::uint32_t> latticeOf(const std::vector<float>& positions, double origin, double step) {
  std::vector<std::uint32_t> stored;
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = static_cast<std::size_t>(axis); i < positions.size(); i += 3)
      stored.push_back(static_cast<std::uint32_t>(std::lround((positions[i] - origin) / step)));
  return stored;
}

std::string portOf(const std::string& url) {
  return url.substr(url.rfind(':') + 1, url.find('/', 8) - url.rfind(':') - 1);
}

/// Requests a file of a stream.
HttpClient::Answer get(const std::string& url, const std::string& file) {
  return HttpClient({"127.0.0.1", portOf(url)}).send("GET", url.substr(url.find("/live/")) + file, "", "", {});
}

Json latest(const std::string& url) {
  return Json::parse(get(url, "/latest").body);
}

Frame newestFrame(const std::string& url) {
  const auto number = latest(url).at("number").get<std::uint64_t>();
  return decodeFrame(asBytes(get(url, "/frames/" + std::to_string(number)).body), "");
}

/// Waits until a condition holds, at most ten seconds.
template <typename Condition> bool eventually(const Condition& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(Publisher, GivesViewersTheQuantisedPositionsExactly) {
  Publisher publisher(gridOptions());
  for (int i = 0; i < 5; ++i) {
    const std::vector<float> positions = waves(0.3F * static_cast<float>(i));
    const PublishReport report = publisher.publishAt(i, positions);
    const Frame frame = newestFrame(publisher.url());
    EXPECT_EQ(frame.number, report.number);
    EXPECT_EQ(frame.time, i);
    EXPECT_EQ(frame.layout.columns, 16u);
    EXPECT_EQ(frame.components, latticeOf(positions, -1, 2.0 / 65535));
  }
  const Json state = latest(publisher.url());
  EXPECT_EQ(state.at("step").get<double>(), 2.0 / 65535);
  EXPECT_EQ(state.at("origin"), Json::parse("[-1, -1, -1]"));
  EXPECT_EQ(publisher.totals().published, 5u);
}

TEST(Publisher, CarriesNormalsColorsAndValues) {
  PublisherOptions options = gridOptions();
  options.normals = 8;
  options.colors = 4;
  options.values = {{0, 10}, {-1, 1}};
  options.valueBits = 12;
  Publisher publisher(options);
  const std::size_t vertices = 16 * 12;
  std::vector<float> normals, colors, values;
  for (std::size_t i = 0; i < vertices; ++i) {
    normals.insert(normals.end(), {0, 2, 0});
    colors.insert(colors.end(), {0, 0.5F, 1, 0.2F});
    values.insert(values.end(), {10, 0});
  }
  publisher.publish(waves(0), normals, colors, values);
  const Frame frame = newestFrame(publisher.url());
  const auto first = [&](std::uint32_t component) { return frame.component(component)[vertices - 1]; };
  // +y is the middle of the upper edge of the octahedron's square.
  EXPECT_EQ(first(3), 127u);
  EXPECT_EQ(first(4), 254u);
  EXPECT_EQ(first(5), 0u);
  EXPECT_EQ(first(6), 128u);
  EXPECT_EQ(first(7), 255u);
  EXPECT_EQ(first(8), 51u);
  EXPECT_EQ(first(9), 4095u);
  EXPECT_EQ(first(10), 2048u);
}

TEST(Publisher, ClampsAndCountsWhatIsOutsideOfTheBox) {
  PublisherOptions options = gridOptions();
  options.box.max[1] = 0.25;
  Publisher publisher(options);
  std::vector<float> positions = waves(0);
  positions[0] = -5;
  positions[1] = 1;
  positions[2] = std::nanf("");
  positions[3] = std::numeric_limits<float>::infinity();
  for (std::size_t i = 4; i < positions.size(); i += 3)
    positions[i] = 0;
  const PublishReport report = publisher.publish(positions);
  EXPECT_EQ(report.clamped, 4u);
  const Frame frame = newestFrame(publisher.url());
  EXPECT_EQ(frame.component(0)[0], 0u);
  EXPECT_EQ(frame.component(1)[0], 40959u) << "1.25 of 2 m";
  EXPECT_EQ(frame.component(2)[0], 0u);
  EXPECT_EQ(frame.component(0)[1], 65535u);
  EXPECT_EQ(latest(publisher.url()).at("clamped"), 4);
}

TEST(Publisher, RefusesOptionsAndArraysThatDoNotFit) {
  const auto refused = [](const std::function<void(PublisherOptions&)>& change) {
    PublisherOptions options = gridOptions();
    change(options);
    EXPECT_THROW(Publisher{options}, Error);
  };
  refused([](PublisherOptions& options) { options.name = "a b"; });
  refused([](PublisherOptions& options) { options.name = ""; });
  refused([](PublisherOptions& options) { options.box.max = options.box.min; });
  refused([](PublisherOptions& options) { options.box.max[0] = std::nan(""); });
  refused([](PublisherOptions& options) { options.topology.columns = 7; });
  refused([](PublisherOptions& options) { options.topology = Topology::order(5'000'000); });
  refused([](PublisherOptions& options) { options.bits = 25; });
  refused([](PublisherOptions& options) { options.normals = 4; });
  refused([](PublisherOptions& options) { options.colors = 2; });
  refused([](PublisherOptions& options) { options.values.resize(5); });
  refused([](PublisherOptions& options) { options.rate = -1; });
  refused([](PublisherOptions& options) { options.to = "https://example.org"; });
  Publisher publisher(gridOptions());
  std::vector<float> positions = waves(0);
  positions.pop_back();
  EXPECT_THROW(publisher.publish(positions), Error);
  EXPECT_THROW(publisher.publish(waves(0), waves(0)), Error) << "the stream has no normals";
}

TEST(Publisher, BeginsAnEpochWithAnotherGrid) {
  PublisherOptions options = gridOptions();
  Publisher publisher(options);
  publisher.publish(waves(0));
  const std::uint64_t first = newestFrame(publisher.url()).epoch;
  options.topology = Topology::order(2);
  publisher.beginEpoch(options);
  publisher.publish(std::vector<float>{0, 0, 0, 1, 1, 1});
  const Frame frame = newestFrame(publisher.url());
  EXPECT_EQ(frame.epoch, first + 1);
  EXPECT_EQ(frame.number, first + 1);
  EXPECT_EQ(frame.layout.vertices, 2u);
}

TEST(Publisher, SharesAServerFromSeveralThreads) {
  ServerOptions serverOptions;
  serverOptions.port = 0;
  Server server(serverOptions);
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      PublisherOptions options = gridOptions();
      options.name = "waves" + std::to_string(thread);
      Publisher publisher(server, options);
      for (int i = 0; i < 50; ++i)
        publisher.publish(waves(static_cast<float>(i)));
      EXPECT_EQ(newestFrame(publisher.url()).components, latticeOf(waves(49), -1, 2.0 / 65535));
    });
  for (std::thread& thread : threads)
    thread.join();
}

TEST(Publisher, PublishesToAServerElsewhere) {
  ServerOptions serverOptions;
  serverOptions.port = 0;
  serverOptions.publishToken = "secret";
  std::optional<Server> server(serverOptions);
  serverOptions.port = server->port();
  PublisherOptions options = gridOptions();
  options.to = server->url();
  options.token = "secret";
  Publisher publisher(options);
  publisher.publish(waves(0));
  ASSERT_TRUE(eventually([&] { return publisher.totals().published == 1; })) << publisher.totals().failure;
  EXPECT_EQ(newestFrame(publisher.url()).components, latticeOf(waves(0), -1, 2.0 / 65535));

  // The server is killed and started again: the publisher announces its stream again by itself.
  server.reset();
  publisher.publish(waves(1));
  ASSERT_TRUE(eventually([&] { return !publisher.totals().failure.empty(); }));
  server.emplace(serverOptions);
  ASSERT_TRUE(eventually([&] {
    publisher.publish(waves(2));
    return publisher.totals().published > 1;
  })) << publisher.totals().failure;
  EXPECT_EQ(newestFrame(publisher.url()).components, latticeOf(waves(2), -1, 2.0 / 65535));
}

TEST(Publisher, SaysWhyAServerRefusesItsStream) {
  ServerOptions serverOptions;
  serverOptions.port = 0;
  serverOptions.publishToken = "secret";
  const Server server(serverOptions);
  PublisherOptions options = gridOptions();
  options.to = server.url();
  options.token = "wrong";
  const Publisher publisher(options);
  ASSERT_TRUE(eventually([&] { return !publisher.totals().failure.empty(); }));
  EXPECT_NE(publisher.totals().failure.find("401"), std::string::npos) << publisher.totals().failure;
}

TEST(PublisherInC, PublishesAndSaysWhatIsWrong) {
  const double box[6] = {-1, -1, -1, 1, 1, 1};
  imgeo_publisher* publisher = imgeo_publisher_create("waves", 16 * 12, 16, box);
  const std::vector<float> positions = waves(1);
  EXPECT_EQ(imgeo_publisher_publish(publisher, NAN, positions.data(), nullptr, nullptr, nullptr), 1);
  EXPECT_NE(std::string(imgeo_publisher_error()), "");
  EXPECT_EQ(imgeo_publisher_set_bits(publisher, 40), 0);
  EXPECT_EQ(imgeo_publisher_listen(publisher, "127.0.0.1", 0), 3);
  EXPECT_EQ(imgeo_publisher_set_bits(publisher, 12), 0);
  ASSERT_EQ(imgeo_publisher_listen(publisher, "127.0.0.1", 0), 0) << imgeo_publisher_error();
  EXPECT_EQ(std::string(imgeo_publisher_error()), "");
  ASSERT_EQ(imgeo_publisher_publish(publisher, 2.5, positions.data(), nullptr, nullptr, nullptr), 0);
  const std::string url = imgeo_publisher_url(publisher);
  EXPECT_EQ(newestFrame(url).components, latticeOf(positions, -1, 2.0 / 4095));
  EXPECT_EQ(newestFrame(url).time, 2.5);
  // A changed setting begins an epoch.
  const double range[2] = {0, 1};
  EXPECT_EQ(imgeo_publisher_set_values(publisher, 1, range, 8), 0);
  EXPECT_EQ(imgeo_publisher_publish(publisher, NAN, positions.data(), nullptr, nullptr, nullptr), 1);
  const std::vector<float> values(16 * 12, 1);
  EXPECT_EQ(imgeo_publisher_publish(publisher, NAN, positions.data(), nullptr, nullptr, values.data()), 0);
  EXPECT_EQ(newestFrame(url).component(3)[0], 255u);
  EXPECT_EQ(imgeo_publisher_totals(publisher).published, 2u);
  imgeo_publisher_destroy(publisher);
}

} // namespace
} // namespace imgeo::live
