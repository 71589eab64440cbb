// Memory that fails on demand: the test program's operator new and mmap count down and fail.
#pragma once

#include <cstddef>

namespace locus::test {

// While one lives, this thread's allocation number `after` (from 0) fails, once.
class FailingMemory {
public:
    explicit FailingMemory(size_t after) noexcept;
    ~FailingMemory();
    FailingMemory(const FailingMemory &) = delete;
    FailingMemory &operator=(const FailingMemory &) = delete;
    bool failed() const noexcept; // it has come to that
};

} // namespace locus::test
