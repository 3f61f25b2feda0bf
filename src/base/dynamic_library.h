#pragma once
// Libraries that are loaded when they are first needed, since a program pays at every
// start for those that it names, and for all that they name in turn.

#include <bit>

namespace imgeo {

/// A shared library that stays loaded until the process ends. To be made once, as the
/// base of a list of the functions that are called of it:
///
///   struct Zlib : DynamicLibrary {
///     Zlib() : DynamicLibrary("libz.so.1") {}
///     decltype(&::crc32) crc32 = find("crc32");
///   };
class DynamicLibrary {
public:
  /// `name` is the library's soname. Throws Error{io} naming it where it cannot be loaded.
  explicit DynamicLibrary(const char* name);

protected:
  /// What a name stands for, to be kept as the pointer that its header declares.
  struct Symbol {
    void* address;
    template <typename Function> operator Function*() const { return std::bit_cast<Function*>(address); }
  };

  /// Throws Error{io} naming the library where it has no such function.
  Symbol find(const char* function) const;

private:
  const char* name_;
  void* handle_;
};

} // namespace imgeo
