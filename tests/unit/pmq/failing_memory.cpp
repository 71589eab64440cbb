// The replaced operator new of this test program; and mmap, wrapped by the linker (--wrap), as slabs come from there.
#include "tests/unit/pmq/failing_memory.hpp"

#include <cstdlib>
#include <new>
#include <sys/mman.h>

namespace {

thread_local bool armed = false;
thread_local size_t countdown = 0;
thread_local bool has_failed = false;

bool fails_now() noexcept {
    if (!armed || countdown-- != 0)
        return false;
    armed = false;
    return has_failed = true;
}

void *allocate(size_t size, size_t alignment) noexcept {
    if (fails_now())
        return nullptr;
    if (alignment <= alignof(std::max_align_t))
        return std::malloc(size ? size : 1);
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment + (size == 0 ? alignment : 0));
}

void *allocate_or_throw(size_t size, size_t alignment = 1) {
    if (void *memory = allocate(size, alignment))
        return memory;
    throw std::bad_alloc();
}

} // namespace

void *operator new(size_t size) { return allocate_or_throw(size); }
void *operator new[](size_t size) { return allocate_or_throw(size); }
void *operator new(size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<size_t>(alignment));
}
void *operator new[](size_t size, std::align_val_t alignment) {
    return allocate_or_throw(size, static_cast<size_t>(alignment));
}
void *operator new(size_t size, const std::nothrow_t &) noexcept { return allocate(size, 1); }
void *operator new[](size_t size, const std::nothrow_t &) noexcept { return allocate(size, 1); }
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete[](void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, size_t) noexcept { std::free(memory); }
void operator delete[](void *memory, size_t) noexcept { std::free(memory); }
void operator delete(void *memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void *memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void *memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void *memory, size_t, std::align_val_t) noexcept { std::free(memory); }
extern "C" {
void *__real_mmap(void *address, size_t length, int protection, int flags, int file,
                  off_t offset); // the linker's names
void *__wrap_mmap(void *address, size_t length, int protection, int flags, int file, off_t offset) {
    return fails_now() ? MAP_FAILED : __real_mmap(address, length, protection, flags, file, offset);
}
}

void operator delete(void *memory, const std::nothrow_t &) noexcept { std::free(memory); }
void operator delete[](void *memory, const std::nothrow_t &) noexcept { std::free(memory); }

namespace locus::test {

FailingMemory::FailingMemory(size_t after) noexcept {
    armed = true;
    countdown = after;
    has_failed = false;
}
FailingMemory::~FailingMemory() { armed = false; }
bool FailingMemory::failed() const noexcept { return has_failed; }

} // namespace locus::test
