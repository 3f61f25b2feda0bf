#include "base/dynamic_library.h"

#include "base/error.h"

#include <dlfcn.h>
#include <fmt/format.h>

namespace imgeo {

DynamicLibrary::DynamicLibrary(const char* name) : name_(name), handle_(dlopen(name, RTLD_LAZY | RTLD_LOCAL)) {
  if (!handle_)
    throw Error(ErrorKind::io, name, fmt::format("cannot be loaded: {}", dlerror()));
}

DynamicLibrary::Symbol DynamicLibrary::find(const char* function) const {
  void* const address = dlsym(handle_, function);
  if (!address)
    throw Error(ErrorKind::io, name_, fmt::format("has no function {}", function));
  return {address};
}

} // namespace imgeo
