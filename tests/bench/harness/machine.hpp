// What the numbers were measured on.
#ifndef LOCUS_BENCH_MACHINE_HPP
#define LOCUS_BENCH_MACHINE_HPP

#include <string>

namespace bench {

/// The processor's name as the kernel gives it.
std::string cpu_name();
/// The commit the program was built from (the environment's BENCH_COMMIT, set by make), or "unknown".
std::string commit();
/// What the library was built with: the words after the version in locus_version_text().
std::string build_target();
/// Bytes per second that `threads` threads together read and write while they copy large blocks.
double copy_bandwidth(unsigned threads);
/// The most memory that this process has had.
std::size_t peak_bytes();
/// Bytes that malloc has handed out and not got back.
std::size_t allocated_bytes();

/// Have the system hold `bytes` of free memory in large pages that were touched just now: a hypervisor that takes free
/// pages back gives them again at many times the cost of clearing them, which is not what a case times.
void provide_memory(std::size_t bytes);

} // namespace bench
#endif
