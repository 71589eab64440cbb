// A team of threads for one call.
#include "core/team.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

namespace locus {
namespace {

#ifdef __linux__
int this_core() { return sched_getcpu(); }

// On a busy machine a new thread may come to lie on its maker's core, and the two take turns there for longer than the
// whole call. Step aside, once: afterwards the thread may run wherever it might before.
void leave_core(int core) {
    cpu_set_t allowed;
    if (core < 0 || core >= CPU_SETSIZE || this_core() != core || sched_getaffinity(0, sizeof allowed, &allowed) != 0 ||
        !CPU_ISSET(core, &allowed) || CPU_COUNT(&allowed) < 2)
        return;
    cpu_set_t others = allowed;
    CPU_CLR(core, &others);
    if (sched_setaffinity(0, sizeof others, &others) == 0)
        sched_setaffinity(0, sizeof allowed, &allowed);
}
#else
int this_core() { return -1; }
void leave_core(int) {}
#endif

} // namespace

uint32_t default_threads() noexcept { return std::max(1u, std::thread::hardware_concurrency()); }

void run_team(uint32_t threads, const std::function<void(uint32_t)> &body) {
    if (threads <= 1)
        return body(0);
    std::vector<std::exception_ptr> errors(threads);
    const auto guarded = [&](uint32_t rank) noexcept {
        try {
            body(rank);
        } catch (...) {
            errors[rank] = std::current_exception();
        }
    };
    const int core = this_core();
    const auto aside = [&](uint32_t rank) noexcept {
        leave_core(core);
        guarded(rank);
    };
    std::vector<std::thread> team;
    team.reserve(threads - 1);
    uint32_t rank = 1;
    try {
        for (; rank < threads; ++rank)
            team.emplace_back(aside, rank);
    } catch (const std::exception &) { // no more threads, or no memory: the caller does the other ranks itself
    }
    guarded(0);
    for (; rank < threads; ++rank)
        guarded(rank);
    for (std::thread &thread : team)
        thread.join();
    for (const std::exception_ptr &error : errors)
        if (error)
            std::rethrow_exception(error);
}

void parallel_for(uint32_t threads, uint64_t count, uint64_t grain,
                  const std::function<void(uint64_t, uint64_t)> &body) {
    grain = std::max<uint64_t>(grain, 1);
    const uint64_t pieces = count / grain + (count % grain != 0);
    std::atomic<uint64_t> next{0};
    run_team(static_cast<uint32_t>(std::min<uint64_t>(threads, std::max<uint64_t>(pieces, 1))), [&](uint32_t) {
        for (uint64_t piece; (piece = next.fetch_add(1, std::memory_order_relaxed)) < pieces;)
            body(piece * grain, std::min(count, (piece + 1) * grain));
    });
}

} // namespace locus
