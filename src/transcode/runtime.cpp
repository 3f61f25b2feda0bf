#include "transcode/runtime.h"

extern "C" {
// Placed by runtime_module.S around the bytes of the bundle.
extern const char imgeoRuntimeBegin[];
extern const char imgeoRuntimeEnd[];
}

namespace imgeo {

std::string_view runtimeModule() {
  return {imgeoRuntimeBegin, imgeoRuntimeEnd};
}

} // namespace imgeo
