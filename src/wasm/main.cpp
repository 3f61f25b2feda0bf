// The exports of the WebAssembly module that decodes SIG compact in browsers, for
// web/src/decode/compact/wasmDecoder.ts, and what it needs of a run-time library: memory, and the end of a decode by an
// Error.
//
// The module keeps nothing from one file to the next. `reserve` discards all memory, so nothing has to be freed; memory
// that was allocated last is, so that growing vectors reuse it.

#include "base/error.h"
#include "containers/compact/patch_coding.h"
#include "wasm/patch_buffers.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>

extern "C" {
[[noreturn]] __attribute__((import_module("imgeo"), import_name("refuse"))) void refuse(std::uint32_t kind);
extern std::byte __heap_base; // defined by the linker: the memory from here to its end is free
}

namespace {

constexpr std::size_t pageSize = 65536, alignment = 16;
constexpr std::size_t growth = 16; ///< pages that memory grows by at least

std::uintptr_t heapBegin() {
  return (reinterpret_cast<std::uintptr_t>(&__heap_base) + alignment - 1) / alignment * alignment;
}
std::uintptr_t heapEnd = 0; ///< of the allocated memory; 0: nothing is allocated

std::size_t rounded(std::size_t size) {
  return (size + alignment - 1) / alignment * alignment;
}

void* allocate(std::size_t size) {
  const std::uintptr_t begin = heapEnd;
  if (size > SIZE_MAX - alignment - begin)
    __builtin_trap();
  heapEnd = begin + rounded(size);
  const std::size_t pages = __builtin_wasm_memory_size(0), needed = (heapEnd + pageSize - 1) / pageSize;
  if (needed > pages) {
    const std::size_t more = needed - pages;
    if (__builtin_wasm_memory_grow(0, more > growth ? more : growth) == SIZE_MAX &&
        __builtin_wasm_memory_grow(0, more) == SIZE_MAX)
      __builtin_trap();
  }
  return reinterpret_cast<void*>(begin);
}

void release(void* memory, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  if (begin + rounded(size) == heapEnd)
    heapEnd = begin;
}

} // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void*) noexcept {}
void operator delete[](void*) noexcept {}
void operator delete(void* memory, std::size_t size) noexcept {
  release(memory, size);
}
void operator delete[](void* memory, std::size_t size) noexcept {
  release(memory, size);
}

// An Error leaves the module where it is made: JavaScript throws, and nothing unwinds. The caller drops the instance.
imgeo::Error::Error(ErrorKind kind, std::string, std::string) {
  refuse(static_cast<std::uint32_t>(kind));
}

// What the code around a throw calls. It is not reached.
extern "C" void* __cxa_allocate_exception(std::size_t size) noexcept {
  return allocate(size);
}
extern "C" [[noreturn]] void __cxa_throw(void*, void*, void*) {
  __builtin_trap();
}

// The functions of libc++ that its headers leave to its library. That library is not linked: with these functions come
// streams and locales. Messages do not leave the module, so their numbers need no digits.
_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) {
  __builtin_trap();
}
string to_string(unsigned) {
  return {};
}
string to_string(int) {
  return {};
}
template class basic_string<char>;
_LIBCPP_END_NAMESPACE_STD
namespace std {
exception::~exception() noexcept = default;
const char* exception::what() const noexcept {
  return "";
}
} // namespace std

namespace {

using namespace imgeo::compact;

/// The description of all patches: 32-bit words, which JavaScript reads in the same order.
class Table {
public:
  void add(std::size_t word) { words_.push_back(static_cast<std::uint32_t>(word)); }
  void add(const void* memory) { add(reinterpret_cast<std::uintptr_t>(memory)); }
  void add(const ElementArray& array) {
    add(static_cast<std::size_t>(array.type));
    add(array.bytes.get());
    add(array.length);
  }
  void add(const VertexArray& vertices) {
    add(vertices.elements);
    add(vertices.components);
    add(vertices.stride);
  }
  void add(const PatchBuffers& patch) {
    add(static_cast<std::size_t>(patch.topology));
    add(patch.positionBits);
    add(patch.vertexCount);
    add(patch.index);
    add(patch.coord);
    add(patch.attributes.size());
    for (const AttributeBuffer& attribute : patch.attributes) {
      add(static_cast<std::size_t>(attribute.kind));
      add(attribute.bits);
      add(attribute.vertices);
    }
    add(patch.segmentCount);
    add(patch.segments.data());
    add(patch.segments.size());
  }
  const std::uint32_t* words() const { return words_.data(); }

private:
  std::vector<std::uint32_t> words_;
};

} // namespace

/// Discards all memory and returns room for the bytes of a payload.
extern "C" __attribute__((export_name("reserve"))) std::uint8_t* reserve(std::size_t length) {
  heapEnd = heapBegin();
  return static_cast<std::uint8_t*>(allocate(length));
}

/// Decodes the payload that was written to the reserved bytes: patches or bases. Returns the table of their arrays,
/// which begins with their number and is valid until the next `reserve`. The number in the exported name is that of the
/// table's layout. Raise it with each change of the layout: browsers may keep a module longer than the runtime that
/// reads its table, which then finds no function and decodes with TypeScript.
extern "C" __attribute__((export_name("decodeToTable1"))) const std::uint32_t* decode(const std::uint8_t* payload,
                                                                                      std::size_t length) {
  auto* table = new Table; // never deleted, as the arrays: they stay until `reserve`
  std::vector<CompactPatch> patches = decodePatches({payload, length}, {});
  table->add(patches.size());
  for (CompactPatch& patch : patches)
    table->add(*new PatchBuffers(buffersOf(std::move(patch))));
  return table->words();
}
