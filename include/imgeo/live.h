#pragma once
/// @file
/// Live streams: a program publishes vertices, any number of browsers draw them (docs/live.md).

#include "imgeo/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Publishing of live vertex streams. Everything here is safe to use from several threads.
namespace imgeo::live {

/// An axis-aligned box in the units of the scene.
struct Box {
  std::array<double, 3> min{}; ///< smallest x, y, z
  std::array<double, 3> max{}; ///< largest x, y, z
};

/// How many vertices a stream has, and whether they are a grid. Triangles, lines and texture coordinates between them
/// are static files of the page.
struct Topology {
  std::uint32_t vertices = 0; ///< 1 .. 4,194,304
  std::uint32_t columns = 0;  ///< vertices in a row of the grid; 0: no grid

  /// A grid whose vertices come row by row. Neighbours predict one another, so frames are small.
  static Topology grid(std::uint32_t columns, std::uint32_t rows) { return {columns * rows, columns}; }
  /// Vertices without a grid, in an order in which neighbours are near each other.
  static Topology order(std::uint32_t vertices) { return {vertices, 0}; }
};

/// The minimum and maximum of a component of the values.
struct Range {
  double min = 0; ///< becomes the smallest stored integer
  double max = 1; ///< becomes the largest one
};

/// How a server of streams listens.
struct ServerOptions {
  std::string host = "127.0.0.1";                    ///< address to listen on; "0.0.0.0": every network
  std::uint16_t port = 8090;                         ///< 0: any free port, see Server::port()
  std::string directory{};                           ///< also serve the files of this directory; empty: none
  std::string viewToken{};                           ///< that viewers state in `?token=` for streams without a token
                                                     ///< of their own; empty: everybody may view
  std::string publishToken{};                        ///< that lets other programs publish here; empty: none may
  std::size_t maxStreams = 16;                       ///< streams at a time
  std::size_t history = 30;                          ///< frames of a stream that stay available
  std::size_t historyBytes = std::size_t{256} << 20; ///< and at most so many bytes of each
  double maxRate = 0;                                ///< frames per second that others may publish; 0: no limit
};

/// An HTTP server of streams, on threads of its own. It stops at the end of its scope.
class Server {
public:
  /// Listens when it returns. Throws Error{io} if the address cannot be had.
  explicit Server(const ServerOptions& options = {});
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The port that was bound.
  std::uint16_t port() const;
  /// "http://127.0.0.1:8090/"
  std::string url() const;

private:
  friend class Publisher;
  struct State;
  std::unique_ptr<State> state_;
};

/// A stream.
struct PublisherOptions {
  std::string name = "stream";    ///< 1 .. 64 of a-z A-Z 0-9 _ -
  Box box{};                      ///< holds all positions; values outside are clamped and counted
  Topology topology{};            ///< the vertices
  std::uint32_t bits = 16;        ///< of a stored coordinate, 8..24: the step is the longest edge / (2^bits - 1)
  std::uint32_t normals = 0;      ///< bits of each of the two stored numbers of a normal, 8..16; 0: no normals
  std::uint32_t colors = 0;       ///< components of a colour, 3 or 4, 8 bits each; 0: no colours
  std::vector<Range> values{};    ///< one range for each component of the values, at most 4
  std::uint32_t valueBits = 16;   ///< of a stored value, 8..24
  double rate = 0;                ///< frames per second, at most 1000; faster ones are dropped. 0: no limit
  std::size_t history = 30;       ///< frames that stay available, where the publisher has its own server
  std::string host = "127.0.0.1"; ///< address of its own server
  std::uint16_t port = 8090;      ///< port of its own server; 0: any free one
  std::string to{};               ///< publish to this server instead: "http://host:8090"
  std::string token{};            ///< with `to`: the server's token for publishers
  std::string viewToken{};        ///< that viewers of this stream state in `?token=`, at most 256 bytes; empty: that of
                                  ///< the server, if it has one
};

/// What became of a published frame.
struct PublishReport {
  /// The frame's number. Nothing if the frame was dropped, because it came faster than `rate`; with
  /// PublisherOptions::to also nothing as long as the frame is on its way.
  std::optional<std::uint64_t> number;
  std::size_t bytes = 0;     ///< of the encoded frame
  std::uint64_t clamped = 0; ///< values of this frame outside of the box or their range
};

/// Sums over the life of a publisher.
struct PublisherTotals {
  std::uint64_t published = 0; ///< frames
  std::uint64_t dropped = 0;   ///< frames that came faster than `rate` or than the network carries them
  std::uint64_t clamped = 0;   ///< values outside of the box or their range
  std::uint64_t bytes = 0;     ///< of all encoded frames
  std::string failure{};       ///< with PublisherOptions::to: why frames do not arrive at the moment; empty: they do
};

/// Publishes one stream. publish() encodes in the thread that calls it and never waits for a viewer or the network.
class Publisher {
public:
  /// A publisher with its own server, or one that publishes to another (`to`). Throws Error{malformed, limit} for
  /// options out of their range, Error{io} if the address cannot be had.
  explicit Publisher(const PublisherOptions& options);
  /// A publisher on a server that others share. The server outlives the publisher; host, port, history and `to` are not
  /// used.
  Publisher(Server& server, const PublisherOptions& options);
  /// Ends the stream.
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// Publishes the vertices of this moment: x y z of each vertex, and normals (x y z), colours (0..1, sRGB) and values
  /// where the stream has them. Throws Error{usage} where an array has another length.
  PublishReport publish(std::span<const float> positions, std::span<const float> normals = {},
                        std::span<const float> colors = {}, std::span<const float> values = {});
  /// The same for a moment of the publisher's own clock, in seconds. publish() states the seconds since 1970.
  PublishReport publishAt(double seconds, std::span<const float> positions, std::span<const float> normals = {},
                          std::span<const float> colors = {}, std::span<const float> values = {});

  /// Begins an epoch: other vertices, box, bits, attributes or rate. Options that concern the server are not used.
  void beginEpoch(const PublisherOptions& options);

  /// Sums since the publisher was made.
  PublisherTotals totals() const;
  /// Where viewers find the stream: "http://127.0.0.1:8090/live/cloth"
  std::string url() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace imgeo::live
