#include "base/first_readable.h"

namespace imgeo {

Error joined(std::span<const Error> errors) {
  std::string message = errors[0].message();
  for (const Error& error : errors.subspan(1))
    message.append("; ").append(error.what());
  return {errors[0].kind(), errors[0].location(), message};
}

} // namespace imgeo
