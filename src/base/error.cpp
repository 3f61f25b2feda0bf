#include "base/error.h"

#include "base/data_url.h"

#include <utility>

namespace imgeo {

namespace {

/// A data: URL would fill the screen.
std::string shortened(std::string location) {
  constexpr std::size_t maxDataUrlBytes = 60;
  if (location.size() > maxDataUrlBytes && isDataUrl(location))
    location.replace(maxDataUrlBytes, location.npos, "...");
  return location;
}

} // namespace

Error::Error(ErrorKind kind, std::string location, std::string message)
    : kind_(kind), location_(shortened(std::move(location))), message_(std::move(message)),
      what_(location_.empty() ? message_ : location_ + ": " + message_) {}

int exitCode(ErrorKind kind) noexcept {
  switch (kind) {
  case ErrorKind::usage:
    return 1;
  case ErrorKind::io:
    return 2;
  case ErrorKind::truncated:
  case ErrorKind::malformed:
  case ErrorKind::unsupported:
  case ErrorKind::limit:
    return 3;
  }
  return 4;
}

} // namespace imgeo
