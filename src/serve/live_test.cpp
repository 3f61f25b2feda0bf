// Live streams over real connections: docs/live.md, "Requests".
#include "live/frame_samples.h"
#include "serve/serve.h"
#include "serve/testing.h"

#include "base/error.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <thread>

namespace imgeo {
namespace {

using live::FrameLayout, live::Stream;
using testing::Client, testing::lastRequest, testing::requestFor;

constexpr FrameLayout layout{35, 7};

live::Description description(double rate = 0) {
  return {layout, {{0, 0, 0}, {1, 2, 3}}, {}, rate};
}

Bytes frameOf(std::uint64_t number, std::uint64_t epoch) {
  live::Frame frame = live::testing::smoothFrame(layout, static_cast<std::uint32_t>(number % 1000));
  frame.number = number;
  frame.epoch = epoch;
  return encodeFrame(frame);
}

void addFrame(Stream& stream) {
  const Stream::State state = stream.state();
  const Bytes bytes = frameOf(state.next, state.epoch);
  stream.add(live::readFrameHeader(bytes, ""), bytes);
}

std::string bodyOf(const std::string& answer) {
  return answer.substr(answer.find("\r\n\r\n") + 4);
}

bool hasStatus(const std::string& answer, unsigned status) {
  return answer.starts_with(fmt::format("HTTP/1.1 {} ", status));
}

class LiveServer : public ::testing::Test {
protected:
  ~LiveServer() override {
    if (!thread_.joinable())
      return;
    server_->stop();
    thread_.join();
  }

  void start(live::StreamLimits limits = {}, ServeOptions options = {}) {
    options.port = 0;
    options.streams = streams_ = std::make_shared<live::Streams>(std::move(limits));
    server_.emplace(options);
    thread_ = std::thread([this] { server_->run(); });
  }

  std::shared_ptr<Stream> openStream(double rate = 0) {
    const auto stream = streams_->open("cloth");
    stream->beginEpoch(description(rate));
    return stream;
  }

  std::string get(const std::string& target, const std::string& fields = "") const {
    const Client client(server_->port());
    client.send(requestFor(target, fields + lastRequest));
    return client.receiveAll();
  }
  std::string getFrame(std::uint64_t number) const { return get(fmt::format("/live/cloth/frames/{}", number)); }

  std::string post(const std::string& type, std::string_view body, const std::string& fields = "") const {
    const Client client(server_->port());
    client.send(
        fmt::format("POST /live/cloth HTTP/1.1\r\nHost: a\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}{}\r\n", type,
                    body.size(), fields, lastRequest));
    client.send(body);
    return client.receiveAll();
  }

  std::shared_ptr<live::Streams> streams_;
  std::optional<Server> server_;
  std::thread thread_;
};

TEST_F(LiveServer, SendsAFrameOfTheHistoryAsItWasPublished) {
  start();
  const auto stream = openStream();
  addFrame(*stream);
  const std::uint64_t number = stream->state().newest->number();
  const std::string answer = getFrame(number);
  EXPECT_TRUE(hasStatus(answer, 200)) << answer;
  EXPECT_NE(answer.find("Cache-Control: public, max-age=31536000, immutable\r\n"), answer.npos);
  EXPECT_NE(answer.find("Access-Control-Allow-Origin: *\r\n"), answer.npos);
  EXPECT_NE(answer.find(fmt::format("Imgeo-Newest: {}\r\n", number)), answer.npos);
  EXPECT_EQ(bodyOf(answer), asText(*stream->frame(number)->bytes()));
  EXPECT_EQ(live::decodeFrame(asBytes(bodyOf(answer)), "").number, number);
}

TEST_F(LiveServer, MakesARequestForTheNextFrameWaitForIt) {
  start();
  const auto stream = openStream();
  const std::uint64_t next = stream->state().next;
  // Two viewers wait for the first frame, one for the second.
  std::vector<std::string> answers(3);
  std::vector<std::thread> viewers;
  for (std::size_t i = 0; i < answers.size(); ++i)
    viewers.emplace_back([&, i] { answers[i] = getFrame(next + i / 2); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  addFrame(*stream);
  viewers[0].join();
  viewers[1].join();
  EXPECT_TRUE(hasStatus(answers[0], 200));
  EXPECT_EQ(bodyOf(answers[0]), bodyOf(answers[1]));
  EXPECT_EQ(answers[2], "");
  addFrame(*stream);
  viewers[2].join();
  EXPECT_EQ(bodyOf(answers[2]), asText(*stream->frame(next + 1)->bytes()));
}

TEST_F(LiveServer, TellsViewersBehindACacheWhenFramesAppear) {
  start();
  const auto stream = openStream(30);
  const double before = live::millisecondsNow();
  addFrame(*stream);
  const double after = live::millisecondsNow();
  EXPECT_NE(get("/live/cloth/latest").find("\"timed\": false"), std::string::npos);
  EXPECT_NE(get("/live/cloth/latest", "Via: 1.1 nginx\r\n").find("\"timed\": true"), std::string::npos);
  EXPECT_NE(get("/live/cloth/latest", "CDN-Loop: example\r\n").find("\"timed\": true"), std::string::npos);
  const std::string answer = getFrame(stream->state().newest->number());
  const double added = std::stod(answer.substr(answer.find("Imgeo-Added: ") + 13));
  EXPECT_GE(added, before - 0.1);
  EXPECT_LE(added, after + 0.1);
}

TEST_F(LiveServer, AnswersOneConnectionAgainAndAgain) {
  start();
  const auto stream = openStream();
  const Client client(server_->port());
  for (int i = 0; i < 20; ++i) {
    client.send(requestFor(fmt::format("/live/cloth/frames/{}", stream->state().next)));
    addFrame(*stream);
    const std::string answer = client.receiveAnswer();
    EXPECT_TRUE(hasStatus(answer, 200)) << answer;
    EXPECT_EQ(bodyOf(answer), asText(*stream->state().newest->bytes()));
  }
}

TEST_F(LiveServer, LeadsFromFramesThatAreGoneToTheNewestAndRefusesThoseTooFarAhead) {
  live::StreamLimits limits;
  limits.history.frames = 3;
  limits.waitMs = 50;
  start(limits);
  const auto stream = openStream();
  for (int i = 0; i < 5; ++i)
    addFrame(*stream);
  const std::uint64_t next = stream->state().next;
  EXPECT_TRUE(hasStatus(getFrame(next - 3), 200));
  for (const std::uint64_t gone : {next - 4, std::uint64_t{0}}) {
    const std::string answer = getFrame(gone);
    EXPECT_TRUE(hasStatus(answer, 307)) << answer;
    EXPECT_NE(answer.find(fmt::format("Location: {}\r\n", next - 1)), answer.npos);
    EXPECT_NE(answer.find("Cache-Control: no-store\r\n"), answer.npos);
    EXPECT_NE(answer.find("Access-Control-Allow-Origin: *\r\n"), answer.npos);
  }
  const std::string withToken = get(fmt::format("/live/cloth/frames/{}?token=a%20b", next - 4));
  EXPECT_NE(withToken.find(fmt::format("Location: {}?token=a%20b\r\n", next - 1)), withToken.npos) << withToken;
  EXPECT_TRUE(hasStatus(getFrame(next + 8), 404));
  const std::string late = getFrame(next + 7);
  EXPECT_TRUE(hasStatus(late, 503));
  EXPECT_NE(late.find("Retry-After: 1\r\n"), late.npos);
  EXPECT_NE(late.find("Cache-Control: no-store\r\n"), late.npos);
  for (const char* number : {"", "x", "-1", "01", "1.0", "9007199254740992", "99999999999999999999"})
    EXPECT_TRUE(hasStatus(get(fmt::format("/live/cloth/frames/{}", number)), 404)) << number;
  EXPECT_TRUE(hasStatus(get("/live/dragon/latest"), 404));
}

TEST_F(LiveServer, WakesViewersWhenAStreamEnds) {
  start();
  const auto stream = openStream();
  addFrame(*stream);
  std::string answer;
  std::thread viewer([&] { answer = getFrame(stream->state().next); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  stream->end();
  viewer.join();
  EXPECT_TRUE(hasStatus(answer, 404)) << answer;
  EXPECT_NE(get("/live/cloth/latest").find("\"ended\": true"), std::string::npos);
  // The last frame stays.
  EXPECT_TRUE(hasStatus(getFrame(stream->state().newest->number()), 200));
}

TEST_F(LiveServer, StopsWhileViewersWait) {
  start();
  openStream();
  std::thread viewer([&] { getFrame(streams_->find("cloth")->state().next); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto before = std::chrono::steady_clock::now();
  server_->stop();
  thread_.join();
  viewer.join();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::milliseconds(1500));
}

TEST_F(LiveServer, SendsImagesWithABoundaryRightBehindEach) {
  start();
  const auto stream = openStream();
  addFrame(*stream);
  EXPECT_EQ(bodyOf(get("/live/cloth/frame.png")).substr(1, 3), "PNG");
  std::string images;
  std::thread viewer([&] { images = get("/live/cloth/stream.mpng"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  addFrame(*stream);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  stream->end();
  viewer.join();
  const std::string first(asText(*stream->frame(stream->state().newest->number() - 1)->image()));
  const std::string second(asText(*stream->state().newest->image()));
  EXPECT_NE(images.find("multipart/x-mixed-replace; boundary=frame\r\n"), images.npos);
  EXPECT_NE(images.find(first + "\r\n--frame\r\n"), images.npos);
  EXPECT_NE(images.find(second + "\r\n--frame"), images.npos);
  EXPECT_TRUE(images.ends_with("\r\n--frame--\r\n"));
}

TEST_F(LiveServer, TakesStreamsOnlyFromPublishersWithTheToken) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  start(limits);
  const std::string announcement = "{" + live::describe(description()) + "}";
  EXPECT_TRUE(hasStatus(post("application/json", announcement), 401));
  EXPECT_TRUE(hasStatus(post("application/json", announcement, "Authorization: Bearer secre\r\n"), 401));
  EXPECT_EQ(streams_->find("cloth"), nullptr);
  const std::string token = "Authorization: Bearer secret\r\n";
  EXPECT_TRUE(hasStatus(post("application/json", announcement, token), 200));
  const auto stream = streams_->find("cloth");
  ASSERT_NE(stream, nullptr);
  const Stream::State state = stream->state();
  EXPECT_EQ(*state.description, description());
  const Bytes frame = frameOf(state.next, state.epoch);
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(frame)), 401));
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(frame), token), 200));
  EXPECT_EQ(*stream->state().newest->bytes(), frame);
  // The same frame again, one of another epoch, a cut one, one of another layout.
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(frame), token), 409));
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(frameOf(state.next + 1, 5)), token), 409));
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(frame).substr(0, 80), token), 400));
  live::Frame other = live::testing::smoothFrame({36, 6}, 1);
  other.number = state.next + 1;
  other.epoch = state.epoch;
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(encodeFrame(other)), token), 409));
  EXPECT_TRUE(hasStatus(post("text/plain", "hello", token), 415));
  EXPECT_TRUE(hasStatus(post("application/json", "{}", token), 400));
  EXPECT_TRUE(hasStatus(post("application/json", "[[[[", token), 400));
  EXPECT_EQ(stream->state().next, state.next + 1);
}

TEST_F(LiveServer, TakesNoStreamsWithoutAToken) {
  start();
  EXPECT_TRUE(hasStatus(post("application/json", "{}"), 403));
}

TEST_F(LiveServer, RefusesLargeBodiesBeforeTheyAreSent) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  start(limits);
  const Client client(server_->port());
  client.send("POST /live/cloth?token=secret HTTP/1.1\r\nHost: a\r\nContent-Length: 99999999999999\r\n\r\n");
  EXPECT_TRUE(hasStatus(client.receiveAnswer(), 413));
  const Client chunked(server_->port());
  chunked.send("POST /live/cloth?token=secret HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n");
  EXPECT_TRUE(hasStatus(chunked.receiveAnswer(), 411));
}

TEST_F(LiveServer, DropsFramesThatComeFasterThanTheirRate) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  start(limits);
  const auto stream = openStream(1);
  const std::string token = "Authorization: Bearer secret\r\n";
  std::size_t refused = 0;
  for (int i = 0; i < 5; ++i) {
    const Bytes frame = frameOf(stream->state().next, stream->state().epoch);
    refused += hasStatus(post("application/x-imgeo-frame", asText(frame), token), 429) ? 1 : 0;
  }
  EXPECT_GE(refused, 3u);
  EXPECT_EQ(stream->droppedCount(), refused);
}

TEST_F(LiveServer, ShowsStreamsOnlyToViewersWithTheToken) {
  live::StreamLimits limits;
  limits.viewToken = "ticket";
  start(limits);
  const auto stream = openStream();
  addFrame(*stream);
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest"), 401));
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest?token=ticke"), 401));
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest?token=ticket"), 200));
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest?a=b&token=ticket"), 200));
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest", "Authorization: Bearer ticket\r\n"), 200));
  EXPECT_TRUE(hasStatus(get("/live/cloth/frame.png"), 401));
  // Caches keep frames by their URL, which has the token or not.
  const std::string frame = "/live/cloth/frames/" + std::to_string(stream->state().newest->number());
  EXPECT_NE(get(frame + "?token=ticket").find("Cache-Control: public,"), std::string::npos);
  EXPECT_NE(get(frame, "Authorization: Bearer ticket\r\n").find("Cache-Control: private,"), std::string::npos);
}

TEST_F(LiveServer, ShowsAStreamWithATokenOfItsOwnOnlyToItsViewers) {
  live::StreamLimits limits;
  limits.viewToken = "ticket";
  limits.publishToken = "secret";
  start(limits);
  const std::string announcement = "{" + live::describe(description()) + ", \"viewToken\": \"a b&c\"}";
  const std::string answer = post("application/json", announcement, "Authorization: Bearer secret\r\n");
  EXPECT_TRUE(hasStatus(answer, 200));
  EXPECT_EQ(answer.find("a b&c"), answer.npos) << "the answer tells the token";
  addFrame(*streams_->find("cloth"));
  const auto other = streams_->open("other");
  other->beginEpoch(description());
  for (const char* file : {"latest", "frame.png", "stream.mpng", "frames/1"}) {
    EXPECT_TRUE(hasStatus(get(fmt::format("/live/cloth/{}", file)), 401)) << file;
    EXPECT_TRUE(hasStatus(get(fmt::format("/live/cloth/{}?token=ticket", file)), 401)) << file;
  }
  const std::string latest = get("/live/cloth/latest?token=a%20b%26c");
  EXPECT_TRUE(hasStatus(latest, 200)) << latest;
  EXPECT_EQ(latest.find("a b&c"), latest.npos);
  EXPECT_TRUE(hasStatus(get("/live/cloth/frame.png", "Authorization: Bearer a b&c\r\n"), 200));
  EXPECT_TRUE(hasStatus(get("/live/cloth/latest?token=a%20b%2"), 401));
  EXPECT_TRUE(hasStatus(get("/live/other/latest?token=ticket"), 200));
  EXPECT_TRUE(hasStatus(get("/live/other/latest?token=a%20b%26c"), 401));
  // A token that is too long, or none.
  const auto announced = [&](const std::string& token) {
    return post("application/json", "{" + live::describe(description()) + ", \"viewToken\": " + token + "}",
                "Authorization: Bearer secret\r\n");
  };
  EXPECT_TRUE(hasStatus(announced('"' + std::string(257, 'x') + '"'), 400));
  EXPECT_TRUE(hasStatus(announced("7"), 400));
}

TEST_F(LiveServer, LimitsStreamsAndTheSizeAndTheRateOfFrames) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  limits.streams = 2;
  limits.frameBytes = 280;
  limits.rate = 4;
  start(limits);
  const std::string token = "Authorization: Bearer secret\r\n";
  streams_->open("a");
  streams_->open("b");
  const std::string full = post("application/json", "{" + live::describe(description()) + "}", token);
  EXPECT_TRUE(hasStatus(full, 413)) << full;
  EXPECT_NE(full.find("one stream too many"), full.npos);
  streams_ = nullptr;
  server_->stop();
  thread_.join();

  limits.streams = 3;
  start(limits);
  const auto stream = openStream(100); // it announces more than the server allows
  live::Frame large = live::testing::noiseFrame(layout, 1);
  large.number = stream->state().next;
  large.epoch = stream->state().epoch;
  EXPECT_GT(encodeFrame(large).size(), limits.frameBytes);
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(encodeFrame(large)), token), 413));
  std::size_t refused = 0;
  for (int i = 0; i < 6; ++i) {
    const Bytes frame = frameOf(stream->state().next, stream->state().epoch);
    ASSERT_LE(frame.size(), limits.frameBytes);
    refused += hasStatus(post("application/x-imgeo-frame", asText(frame), token), 429) ? 1 : 0;
  }
  EXPECT_GE(refused, 2u);
  EXPECT_EQ(stream->droppedCount(), refused);
}

TEST_F(LiveServer, GoesOnWhenAPublisherVanishesAndReturns) {
  live::StreamLimits limits;
  limits.publishToken = "secret";
  limits.waitMs = 200;
  start(limits);
  const std::string token = "Authorization: Bearer secret\r\n",
                    announcement = "{" + live::describe(description()) + "}";
  EXPECT_TRUE(hasStatus(post("application/json", announcement, token), 200));
  const auto stream = streams_->find("cloth");
  const auto next = [&] { return frameOf(stream->state().next, stream->state().epoch); };
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(next()), token), 200));
  const std::uint64_t last = stream->state().newest->number();
  {
    const Client vanishing(server_->port());
    const Bytes frame = next();
    vanishing.send(fmt::format("POST /live/cloth?token=secret HTTP/1.1\r\nHost: a\r\nContent-Type: "
                               "application/x-imgeo-frame\r\nContent-Length: {}\r\n\r\n",
                               frame.size()));
    vanishing.send(asText(frame).substr(0, frame.size() / 2));
  }
  // Viewers wait in vain; the last frame stays.
  EXPECT_TRUE(hasStatus(getFrame(last + 1), 503));
  EXPECT_TRUE(hasStatus(getFrame(last), 200));
  // It returns, with another epoch.
  EXPECT_TRUE(hasStatus(post("application/json", announcement, token), 200));
  EXPECT_EQ(stream->state().epoch, last + 1);
  EXPECT_TRUE(hasStatus(post("application/x-imgeo-frame", asText(next()), token), 200));
  EXPECT_TRUE(hasStatus(getFrame(last + 1), 200));
}

/// Bytes of memory of this process.
std::size_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST_F(LiveServer, KeepsNothingOfViewersWhoConnectAndLeave) {
  const char* stated = std::getenv("IMGEO_VIEWERS"); // make soak: 10,000
  const int viewers = stated ? std::stoi(stated) : 500, together = 100;
  live::StreamLimits limits;
  limits.waitMs = 1000;
  start(limits);
  const auto stream = openStream();
  addFrame(*stream);
  std::size_t before = 0;
  for (int i = 0; i < viewers; i += together) {
    std::vector<std::unique_ptr<Client>> leaving;
    for (int k = 0; k < together; ++k) {
      leaving.push_back(std::make_unique<Client>(server_->port()));
      ASSERT_TRUE(leaving.back()->isConnected());
      const std::uint64_t next = stream->state().next;
      switch (k % 4) {
      case 0: // waits for a frame
        leaving.back()->send(requestFor(fmt::format("/live/cloth/frames/{}", next)));
        break;
      case 1: // does not read images
        leaving.back()->send(requestFor("/live/cloth/stream.mpng"));
        break;
      case 2: // leaves within a request
        leaving.back()->send("GET /live/cloth/fra");
        break;
      default: // says nothing
        break;
      }
    }
    addFrame(*stream);
    EXPECT_TRUE(hasStatus(getFrame(stream->state().newest->number()), 200));
    if (i == 0)
      before = residentBytes(); // what the first hundred need is reused
  }
  addFrame(*stream);
  EXPECT_TRUE(hasStatus(getFrame(stream->state().newest->number()), 200));
  const std::size_t after = residentBytes(), growth = after - std::min(before, after);
  std::cout << viewers << " viewers have left: " << after / 1024 << " KiB of memory, " << growth / 1024
            << " KiB more than after the first hundred\n";
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(growth, std::size_t{32} << 20);
#endif
}

TEST_F(LiveServer, AnswersOtherMethods) {
  start();
  addFrame(*openStream());
  const Client head(server_->port());
  head.send("HEAD /live/cloth/frame.png HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(bodyOf(head.receiveAll()), "");
  const Client endless(server_->port());
  endless.send("HEAD /live/cloth/stream.mpng HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(hasStatus(endless.receiveAll(), 405));
  const Client preflight(server_->port());
  preflight.send("OPTIONS /live/cloth HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(hasStatus(preflight.receiveAll(), 204));
  const Client put(server_->port());
  put.send("PUT /live/cloth/latest HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(hasStatus(put.receiveAll(), 405));
  EXPECT_TRUE(hasStatus(get("/index.html"), 404)) << "a server without a directory has no files";
}

TEST_F(LiveServer, IsNotHeldUpByAViewerThatDoesNotRead) {
  ServeOptions options;
  options.writeTimeoutMs = 200;
  start({}, options);
  const auto stream = openStream();
  addFrame(*stream);
  const Client stalled(server_->port(), 4096);
  stalled.send(requestFor("/live/cloth/stream.mpng"));
  for (int i = 0; i < 50; ++i) {
    addFrame(*stream);
    EXPECT_TRUE(hasStatus(getFrame(stream->state().newest->number()), 200));
  }
}

} // namespace
} // namespace imgeo
