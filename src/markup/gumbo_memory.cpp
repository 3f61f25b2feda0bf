#include "markup/gumbo_memory.h"

#include <cstdlib>
#include <ctime>

namespace imgeo {

namespace {

double threadSeconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

GumboMemory::GumboMemory(std::size_t maxBytes, double maxSeconds)
    : bytesLeft_(maxBytes), endSeconds_(threadSeconds() + maxSeconds) {}

GumboMemory::~GumboMemory() {
  for (Header* header = first_; header;) {
    Header* const next = header->next;
    std::free(header);
    header = next;
  }
}

void* GumboMemory::allocate(void* memory, std::size_t bytes) {
  GumboMemory& self = *static_cast<GumboMemory*>(memory);
  const bool isLate = ++self.allocations_ % 64 == 0 && threadSeconds() > self.endSeconds_;
  Header* const header =
      !isLate && bytes <= self.bytesLeft_ ? static_cast<Header*>(std::malloc(sizeof(Header) + bytes)) : nullptr;
  if (!header)
    std::longjmp(self.exhausted, 1); // no frame between here and setjmp has a destructor
  self.bytesLeft_ -= bytes;
  *header = {nullptr, self.first_, bytes};
  if (self.first_)
    self.first_->previous = header;
  self.first_ = header;
  return header + 1;
}

void GumboMemory::release(void* memory, void* block) {
  if (!block)
    return;
  GumboMemory& self = *static_cast<GumboMemory*>(memory);
  Header* const header = static_cast<Header*>(block) - 1;
  (header->previous ? header->previous->next : self.first_) = header->next;
  if (header->next)
    header->next->previous = header->previous;
  self.bytesLeft_ += header->bytes;
  std::free(header);
}

} // namespace imgeo
