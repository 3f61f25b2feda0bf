#pragma once
// What is left out of a scene because it is damaged.

#include "base/error.h"
#include "import/warnings.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo::gltf {

class Damage {
public:
  explicit Damage(bool isStrict) : isStrict_(isStrict) {}

  /// Calls `read` and turns its Error into a warning. If strict, and for Error{limit}, rethrows it.
  template <typename Read> void attempt(const Read& read) {
    try {
      read();
    } catch (const Error& error) {
      if (isStrict_ || error.kind() == ErrorKind::limit)
        throw;
      if (!first)
        first = error;
      warnings.push_back(leftOut(error));
    }
  }

  std::vector<std::string> warnings; ///< one for each part that is left out
  std::optional<Error> first;        ///< the error of the first of them

private:
  bool isStrict_;
};

} // namespace imgeo::gltf
