#include "imgeo/version.h"

namespace imgeo {

const char* version() noexcept {
  return IMGEO_VERSION;
}

} // namespace imgeo
