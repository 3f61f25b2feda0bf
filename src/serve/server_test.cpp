#include "serve/serve.h"

#include "base/bytes.h"
#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "serve/testing.h"

#include <chrono>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace imgeo {
namespace {

using testing::Client, testing::lastRequest, testing::requestFor;

class ServerOverLoopback : public ::testing::Test {
protected:
  ServerOverLoopback() {
    writeFile(site_.path() / "index.html", asBytes("<p>hello</p>"));
    Bytes large(8'000'003);
    for (std::size_t i = 0; i < large.size(); ++i)
      large[i] = static_cast<std::uint8_t>(i * 31 >> 5);
    writeFile(site_.path() / "large.bin", large);
    large_ = std::move(large);
  }
  ~ServerOverLoopback() override { stop(); }

  std::uint16_t start(ServeOptions options = {}) {
    options.directory = site_.path();
    options.port = 0;
    server_.emplace(options);
    thread_ = std::thread([this] { server_->run(); });
    return server_->port();
  }
  void stop() {
    if (!thread_.joinable())
      return;
    server_->stop();
    thread_.join();
  }

  testing::TemporaryDirectory site_;
  Bytes large_;
  std::optional<Server> server_;
  std::thread thread_;
};

TEST_F(ServerOverLoopback, ServesAFile) {
  Client client(start());
  ASSERT_TRUE(client.send(requestFor("/", lastRequest)));
  const std::string answer = client.receiveAll();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\n<p>hello</p>")) << answer;
  EXPECT_NE(answer.find("\r\nDate: "), std::string::npos);
  EXPECT_NE(answer.find("\r\nConnection: close\r\n"), std::string::npos);
}

TEST_F(ServerOverLoopback, ReturnsItsUrl) {
  const std::uint16_t port = start();
  EXPECT_NE(port, 0);
  EXPECT_EQ(server_->url(), fmt::format("http://127.0.0.1:{}/", port));
}

TEST_F(ServerOverLoopback, ALargeFileArrivesCompleteAndInOrder) {
  Client client(start());
  client.send(requestFor("/large.bin", lastRequest));
  const std::string answer = client.receiveAll();
  EXPECT_TRUE(answer.ends_with(asText(large_)));
}

TEST_F(ServerOverLoopback, ARangeOfALargeFileIsExact) {
  Client client(start());
  client.send(requestFor("/large.bin", "Range: bytes=1000001-1200000\r\nConnection: close\r\n"));
  const std::string answer = client.receiveAll();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 206 Partial Content\r\n"));
  EXPECT_EQ(answer.substr(answer.find("\r\n\r\n") + 4), asText(large_).substr(1'000'001, 200'000));
}

TEST_F(ServerOverLoopback, AConnectionServesSeveralRequests) {
  Client client(start());
  for (int i = 0; i < 3; ++i) {
    client.send(requestFor("/"));
    EXPECT_TRUE(client.receiveAnswer().ends_with("<p>hello</p>"));
  }
}

TEST_F(ServerOverLoopback, PipelinedRequestsAreAnsweredInOrder) {
  Client client(start());
  client.send(requestFor("/") + requestFor("/missing") + "HEAD / HTTP/1.1\r\nHost: test\r\n\r\n" +
              requestFor("/", lastRequest));
  const std::string answers = client.receiveAll();
  const std::size_t first = answers.find("200 OK"), second = answers.find("404 Not Found", first),
                    third = answers.find("200 OK", second), fourth = answers.find("200 OK", third + 1);
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(fourth, std::string::npos);
  EXPECT_TRUE(answers.ends_with("<p>hello</p>"));
}

TEST_F(ServerOverLoopback, ARequestThatArrivesByteByByteIsAnswered) {
  Client client(start());
  for (const char c : requestFor("/", lastRequest)) {
    client.send({&c, 1});
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  EXPECT_TRUE(client.receiveAll().ends_with("<p>hello</p>"));
}

TEST_F(ServerOverLoopback, HostileRequestsAreRefusedAndTheServerContinues) {
  const std::uint16_t port = start();
  const std::pair<std::string, const char*> cases[] = {
      {"\r\n\r\n\r\n", "400"},
      {"nonsense\r\n\r\n", "400"},
      {"GET\r\n\r\n", "400"},
      {"GET / HTTP/9.9\r\nHost: a\r\n\r\n", "505"},
      {"GET / HTTP/1.1\r\n\r\n", "400"}, // no Host
      {"GET / HTTP/1.1\r\nHost: a\r\nno colon\r\n\r\n", "400"},
      {"GET / HTTP/1.1\r\nHost: a\r\nContent-Length: x\r\n\r\n", "400"},
      {"GET / HTTP/1.1\r\nHost: a\r\nContent-Length: -1\r\n\r\n", "400"},
      {"GET /%zz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", "400"},
      {"GET /../../etc/passwd HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", "400"},
      {"GET /%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", "400"},
      {"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\nhello", "405"},
      {"BREW / HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", "405"},
      {std::string("GET /\0 HTTP/1.1\r\nHost: a\r\n\r\n", 29), "400"},
      {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11) + std::string(200, '\x01'), "400"}, // TLS
      {"GET /" + std::string(40'000, 'a') + " HTTP/1.1\r\nHost: a\r\n\r\n", "431"},
      {"GET / HTTP/1.1\r\nHost: a\r\nX: " + std::string(40'000, 'a') + "\r\n\r\n", "431"},
  };
  for (const auto& [request, status] : cases) {
    Client client(port);
    client.send(request);
    client.sendEnd();
    const std::string answer = client.receiveAll();
    EXPECT_TRUE(answer.starts_with(fmt::format("HTTP/1.1 {} ", status)))
        << request.substr(0, 60) << "\n gave " << answer.substr(0, 200);
    EXPECT_EQ(answer.find("root:"), std::string::npos);
  }
  Client client(port);
  client.send(requestFor("/", lastRequest));
  EXPECT_TRUE(client.receiveAll().ends_with("<p>hello</p>"));
}

TEST_F(ServerOverLoopback, BytesBehindABodyAreNotReadAsARequest) {
  Client client(start());
  const std::string hidden = requestFor("/large.bin");
  client.send(fmt::format("GET / HTTP/1.1\r\nHost: a\r\nContent-Length: {}\r\n\r\n{}", hidden.size(), hidden));
  const std::string answer = client.receiveAll();
  EXPECT_TRUE(answer.ends_with("<p>hello</p>")) << answer.size();
}

TEST_F(ServerOverLoopback, AnUnfinishedHeadTimesOut) {
  ServeOptions options;
  options.headTimeoutMs = 200;
  Client client(start(options));
  client.send("GET / HTTP/1.1\r\nHost: slow");
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(client.receiveAll(), "");
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

TEST_F(ServerOverLoopback, AClientThatDoesNotReadTimesOut) {
  ServeOptions options;
  options.writeTimeoutMs = 200;
  Client client(start(options), 4096);
  client.send(requestFor("/large.bin", lastRequest));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_LT(client.receiveAll().size(), large_.size());
}

TEST_F(ServerOverLoopback, ManySimultaneousConnectionsAreServed) {
  ServeOptions options;
  options.threads = 2;
  const std::uint16_t port = start(options);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 400; ++i) {
    clients.push_back(std::make_unique<Client>(port));
    ASSERT_TRUE(clients.back()->isConnected()) << i;
  }
  for (const auto& client : clients)
    ASSERT_TRUE(client->send(requestFor("/")));
  for (const auto& client : clients)
    EXPECT_TRUE(client->receiveAnswer().ends_with("<p>hello</p>"));
}

TEST_F(ServerOverLoopback, StopClosesIdleConnectionsImmediately) {
  Client client(start());
  client.send(requestFor("/"));
  client.receiveAnswer();
  const auto before = std::chrono::steady_clock::now();
  stop();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
  EXPECT_EQ(client.receiveAll(), "");
}

TEST_F(ServerOverLoopback, StopFinishesResponsesThatHaveBegun) {
  const std::uint16_t port = start();
  Client client(port, 4096);
  client.send(requestFor("/large.bin"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  server_->stop();
  EXPECT_TRUE(client.receiveAll().ends_with(asText(large_)));
  stop();
  EXPECT_FALSE(Client(port).isConnected());
}

TEST_F(ServerOverLoopback, StopWaitsNoLongerThanItsTimeout) {
  ServeOptions options;
  options.stopTimeoutMs = 200;
  Client client(start(options), 4096);
  client.send(requestFor("/large.bin"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto before = std::chrono::steady_clock::now();
  stop();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(3));
}

TEST_F(ServerOverLoopback, RunReturnsImmediatelyAfterAnEarlierStop) {
  ServeOptions options;
  options.directory = site_.path();
  options.port = 0;
  Server server(options);
  server.stop();
  server.stop();
  server.run();
}

TEST_F(ServerOverLoopback, AnInterruptSignalStopsTheServer) {
  ServeOptions options;
  options.directory = site_.path();
  options.port = 0;
  options.stopOnSignals = true;
  Server server(options);
  std::thread thread([&] { server.run(); });
  kill(getpid(), SIGINT);
  thread.join();
}

TEST_F(ServerOverLoopback, APortInUseIsAnErrorOfOneSentence) {
  ServeOptions options;
  options.directory = site_.path();
  options.port = start();
  try {
    const Server second(options);
    FAIL() << "bound a port twice";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(std::string(error.what()), fmt::format("127.0.0.1:{}: the port is in use already", options.port));
  }
}

TEST_F(ServerOverLoopback, AMissingDirectoryAndAnInvalidHostAreErrors) {
  ServeOptions options;
  options.port = 0;
  options.directory = site_.path() / "missing";
  EXPECT_THROW(Server{options}, Error);
  options.directory = site_.path() / "index.html";
  EXPECT_THROW(Server{options}, Error);
  options.directory = site_.path();
  options.host = "no such host";
  EXPECT_THROW(Server{options}, Error);
}

} // namespace
} // namespace imgeo
