// A device that is none: the bodies of all kernels on the host, items, threads and blocks in an order that changes from
// launch to launch, memory that begins as rubbish. What a kernel may not rely on, it does not get.
#pragma once

#include "graph/device/table.hpp"

namespace locus::device::emulated {

struct Settings {
    uint64_t seed = 1;          // of the orders
    uint32_t threads = 1;       // host threads that run the items and blocks of a launch
    uint32_t blocks = 3;        // a kernel's resident blocks
    uint32_t lanes = 0;         // host threads that run the threads of a block at the same time; see lanes.hpp
    int64_t calls_left = -1;    // after so many calls that may fail one fails; negative: none does
    void *stream = nullptr;     // what every kernel must be put on, where it is not null
    bool keeps_failing = false; // all calls after that one
    int32_t failure = LOCUS_E_DEVICE;
    uint64_t memory = UINT64_MAX;     // bytes
    uint64_t block_memory = 96 << 10; // bytes that blocks may share
};

// What was done since the counters were set to zero.
struct Counters {
    uint64_t launches = 0, items = 0, uploaded = 0, downloaded = 0, allocated = 0; // allocated: bytes at present
};

Settings &settings();
Counters &counters();
const Table &table();

// The settings are as before when it goes.
struct KeepSettings {
    const Settings before = settings();
    ~KeepSettings() { settings() = before; }
};

} // namespace locus::device::emulated
