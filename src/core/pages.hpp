// Memory in large pages where the system has them: for arrays that are walked over and over, by threads whose own heaps
// the C library keeps in small pages.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace locus {

constexpr std::size_t large_page = std::size_t{1} << 21;

// At the start of a large page; to be ended with free_pages. Throws std::bad_alloc.
inline void *allocate_pages(std::size_t bytes) {
    void *const raw = ::operator new (bytes, std::align_val_t{large_page});
#ifdef __linux__
    madvise(raw, bytes, MADV_HUGEPAGE); // a hint: nothing is lost where it fails
#endif
    return raw;
}
inline void free_pages(void *raw) noexcept { ::operator delete (raw, std::align_val_t{large_page}); }

// Ask for large pages for those that lie wholly in memory which was not used yet.
inline void prefer_large_pages([[maybe_unused]] void *raw, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    void *first = raw;
    if (std::align(large_page, large_page, first, bytes) != nullptr)
        madvise(first, bytes / large_page * large_page, MADV_HUGEPAGE);
#endif
}

// For containers: large pages where their memory fills one, cache lines below.
template <typename T>
struct PageAllocator {
    using value_type = T;
    PageAllocator() = default;
    template <typename Other>
    PageAllocator(const PageAllocator<Other> &) noexcept {}

    T *allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T))
            throw std::bad_array_new_length();
        const std::size_t bytes = count * sizeof(T);
        return static_cast<T *>(bytes >= large_page ? allocate_pages(bytes) : ::operator new(bytes, line));
    }
    void deallocate(T *raw, std::size_t count) noexcept {
        if (count * sizeof(T) >= large_page)
            free_pages(raw);
        else
            ::operator delete(raw, line);
    }
    bool operator==(const PageAllocator &) const = default;

private:
    static constexpr std::align_val_t line{64};
};

} // namespace locus
