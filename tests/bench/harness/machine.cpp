// The machine's description and its copy bandwidth.
#include "tests/bench/harness/machine.hpp"

#include "tests/bench/harness/clock.hpp"

#include <locus/status.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <thread>
#include <vector>

namespace bench {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.rfind("model name", 0) == 0) {
            return line.substr(std::min(line.size(), line.find(':') + 2));
        }
    }
    return "unknown";
}

std::string commit() {
    const char *text = std::getenv("BENCH_COMMIT");
    return text != nullptr && *text != '\0' ? text : "unknown";
}

std::string build_target() {
    const std::string text = locus_version_text();
    const std::size_t space = text.find(' ');
    return space == std::string::npos ? text : text.substr(space + 1);
}

double copy_bandwidth(unsigned threads) {
    constexpr std::size_t block = std::size_t{96} << 20;
    std::vector<std::vector<char>> from(threads, std::vector<char>(block, 1)), to(threads, std::vector<char>(block, 2));
    double best = 1e30;
    for (int round = 0; round < 5; ++round) {
        best = std::min(best, timed_wall([&] {
                            std::vector<std::thread> team;
                            for (unsigned t = 0; t < threads; ++t) {
                                team.emplace_back([&, t] { std::memcpy(to[t].data(), from[t].data(), block); });
                            }
                            for (std::thread &thread : team) {
                                thread.join();
                            }
                        }));
    }
    return 2.0 * static_cast<double>(block) * threads / best;
}

std::size_t peak_bytes() {
    struct rusage usage {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

std::size_t allocated_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

void provide_memory(std::size_t bytes) {
    void *memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        return;
    }
    madvise(memory, bytes, MADV_HUGEPAGE);
    constexpr std::size_t page = 4096;
    for (std::size_t at = 0; at < bytes; at += page) {
        static_cast<volatile char *>(memory)[at] = 0;
    }
    munmap(memory, bytes);
}

} // namespace bench
