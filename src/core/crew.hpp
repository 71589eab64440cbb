// Threads that stay together for many short loops of one call, where a team for each (team.hpp) would hardly have
// started before its loop is done.
#pragma once

#include "core/function_ref.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace locus {

class Crew {
public:
    // The calling thread is one of the threads; fewer start where the system has no more to give. Throws
    // std::bad_alloc.
    explicit Crew(uint32_t threads);
    ~Crew(); // ends the threads
    Crew(const Crew &) = delete;
    Crew &operator=(const Crew &) = delete;

    // Split 0..count-1 into pieces of at most `grain`, run body(begin, end) for each, and wait for all. One call at a
    // time; the body must not throw.
    using Body = FunctionRef<void(uint64_t begin, uint64_t end)>;
    void for_each(uint64_t count, uint64_t grain, Body body);

private:
    struct Loop {
        const Body *body; // NULL: none is open
        uint64_t count, grain;
    };
    void help();
    void work(const Loop &loop) noexcept;
    void end() noexcept;

    std::vector<std::thread> helpers_;
    std::atomic<uint64_t> next_ = 0; // piece of the loop
    std::mutex mutex_;               // guards what follows
    std::condition_variable begun_, done_;
    Loop loop_{};
    uint64_t loops_ = 0; // so far
    uint32_t busy_ = 0;  // helpers in the loop
    bool ending_ = false;
};

} // namespace locus
