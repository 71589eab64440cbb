// A team of threads for one call: started, put to work and joined within it, so that no thread outlives a call and fork
// and dlclose stay clean.
#pragma once

#include <cstdint>
#include <functional>

namespace locus {

// The threads an option of 0 stands for: one per core.
uint32_t default_threads() noexcept;

// Run body(rank) for the ranks 0..threads-1 at once, rank 0 on the calling thread, and wait for all. Where the system
// has no more threads to give, one thread does the work of several ranks, one after the other: ranks must not wait for
// each other. An exception of any rank is rethrown here after all have ended (the lowest rank's where several throw).
void run_team(uint32_t threads, const std::function<void(uint32_t)> &body);

// Split 0..count-1 into pieces of at most `grain` and run body(begin, end) for each, on up to `threads` threads.
void parallel_for(uint32_t threads, uint64_t count, uint64_t grain,
                  const std::function<void(uint64_t, uint64_t)> &body);

} // namespace locus
