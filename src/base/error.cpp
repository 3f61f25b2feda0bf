#include "base/error.h"

#include <utility>

namespace imgeo {

Error::Error(ErrorKind kind, std::string place, std::string message)
    : kind_(kind), place_(std::move(place)), message_(std::move(message)),
      what_(place_.empty() ? message_ : place_ + ": " + message_) {}

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
