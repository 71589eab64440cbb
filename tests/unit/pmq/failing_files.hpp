// Calls on files that go wrong: the disk is full or broken, or the process ends there.
#pragma once

#include <cstddef>

namespace locus::test {

// While one lives, the calls by which the library changes and reads files are counted, over all threads, and the one
// behind `after` others goes wrong.
class FailingFiles {
public:
    enum class Way {
        refused,      // the call fails with `code`
        killed,       // the process is killed before it,
        killed_behind // or behind it; of what was to be written half has been
    };
    FailingFiles(size_t after, Way way, int code) noexcept;
    ~FailingFiles();
    FailingFiles(const FailingFiles &) = delete;
    FailingFiles &operator=(const FailingFiles &) = delete;
    bool failed() const noexcept; // it came to that call
};

} // namespace locus::test
