// Clocks of the benchmarks: the calling thread's CPU time for work of one thread, wall time for work of several.
#ifndef LOCUS_BENCH_CLOCK_HPP
#define LOCUS_BENCH_CLOCK_HPP

#include <time.h>

namespace bench {

inline double read_clock(clockid_t id) {
    timespec t{};
    clock_gettime(id, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
inline double cpu_seconds() { return read_clock(CLOCK_THREAD_CPUTIME_ID); }
inline double wall_seconds() { return read_clock(CLOCK_MONOTONIC); }

/// Seconds of thread-CPU time that `work` takes.
template <class Work>
double timed(Work &&work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

/// Seconds of wall time that `work` takes.
template <class Work>
double timed_wall(Work &&work) {
    const double start = wall_seconds();
    work();
    return wall_seconds() - start;
}

} // namespace bench
#endif
