#pragma once
// Shared libraries that are loaded at first use. A library that is linked costs loading time at every start, with all
// libraries that it depends on.

#include <bit>

namespace imgeo {

/// A shared library that stays loaded until the process ends. Derive a struct that lists the functions to call, and
/// construct it once:
///
///   struct Zlib : DynamicLibrary {
///     Zlib() : DynamicLibrary("libz.so.1") {}
///     decltype(&::crc32) crc32 = find("crc32");
///   };
class DynamicLibrary {
public:
  /// `name` is the library's soname. Throws Error{io}, which names the library, if it cannot be loaded.
  explicit DynamicLibrary(const char* name);

protected:
  /// The address of a function; converts to the function pointer type that the member declares.
  struct Symbol {
    void* address;
    template <typename Function> operator Function*() const { return std::bit_cast<Function*>(address); }
  };

  /// Throws Error{io}, which names the library, if it has no such function.
  Symbol find(const char* function) const;

private:
  const char* name_;
  void* handle_;
};

} // namespace imgeo
