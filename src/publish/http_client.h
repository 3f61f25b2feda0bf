#pragma once
// A client of one server over HTTP/1.1, for publishers.

#include "base/bytes.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace imgeo::live {

/// "http://host:8090"; the port is 80 where it is not stated.
struct ServerAddress {
  std::string host, port;
};

/// Throws Error{usage} for a URL of another kind, such as https, which a proxy on this machine can add.
ServerAddress parseServerAddress(const std::string& url);

/// Keeps its connection open and opens it again where it has broken. Not safe to use from several threads.
class HttpClient {
public:
  explicit HttpClient(ServerAddress address);
  ~HttpClient();

  struct Answer {
    unsigned status = 0;
    std::string body;
  };
  /// Sends a request and waits for the answer, at most ten seconds. Throws Error{io} naming the server.
  Answer send(const std::string& method, const std::string& target, const std::string& contentType,
              const std::string& token, const Bytes& body);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace imgeo::live
