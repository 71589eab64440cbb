// The interface between liblocus and a library that runs its kernels, liblocus_cuda.so: one function, whose name
// carries the version, gives a table of plain functions. Both libraries must be of one build: bodies of kernels are
// handed over as they lie in memory. No exception crosses it; a failed call returns a status of locus/status.h and says
// why.
#pragma once

#include <locus/status.h>

#include <cstdint>

namespace locus::device {

// Grows whenever the table, a body or the meaning of either changes between two releases.
inline constexpr uint32_t kInterface = 3;

enum class Kernel : uint32_t {
    fill_bytes,
    fill_words,
    // graph/device/bricks.hpp, visit.hpp, transfer.hpp
    select,
    wake_list,
    plant,
    lower,
    raise,
    resume,
    import,
    scatter_operands,
    scatter_open,
    gather,
    export_words,
    read,
    tally,
    // graph/device/dense.hpp
    relax,
    update,
    sow,
    // graph/device/sibson.hpp
    sibson,
    sibson_large,
};

struct Launch {
    Kernel kernel;
    uint32_t rule;      // RuleKind
    uint32_t word_bits; // 32 or 64
    uint32_t simple;    // lower, raise: equal spacings
    const void *body;
    uint64_t body_bytes;
    uint64_t memory; // by block: bytes of shared memory beside the body's own
    uint64_t items; // by index: no more than these; by block: blocks to launch, as many as Table::resident says at most
};

struct Machine {
    char name[256];
    uint64_t memory; // bytes
    uint32_t multiprocessors;
    uint32_t compute;      // compute capability, 90 for 9.0
    uint64_t block_memory; // shared memory that a block may have, and a multiprocessor has, in bytes
    uint64_t multiprocessor_memory;
};

struct Message {
    char text[256];
};

struct Queue; // work on a device, one after the other

// How the host copies its own memory: liblocus may do it on several threads.
struct HostCopy {
    void (*run)(void *user, void *to, const void *from, uint64_t bytes);
    void *user;
};

struct Table {
    uint64_t bytes; // of this struct
    uint32_t interface;
    uint32_t version; // LOCUS_VERSION

    int32_t (*open)(Queue **queue, Machine *machine, Message *why);
    void (*close)(Queue *queue);
    // A stream of the caller's (a cudaStream_t; null: one of the queue's own).
    int32_t (*use_stream)(Queue *queue, void *stream, Message *why);
    int32_t (*allocate)(Queue *queue, uint64_t bytes, void **memory, Message *why);
    void (*release)(Queue *queue, void *memory);
    // The host's memory may be used again on return. `copy`: null where one thread is to do.
    int32_t (*upload)(Queue *queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why);
    // Waits for all that was put into the queue before.
    int32_t (*download)(Queue *queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why);
    // Whether kernels may write to memory of the caller's; `why` says why not.
    int32_t (*writable)(Queue *queue, const void *memory, Message *why);
    int32_t (*launch)(Queue *queue, const Launch *launch, Message *why);
    // How many blocks of a kernel run at the same time.
    int32_t (*resident)(Queue *queue, const Launch *launch, uint64_t *blocks, Message *why);
    // The numbers i < count with flags[i] != 0 into `list`, in rising order, and how many they are into `listed`.
    int32_t (*compact)(Queue *queue, const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed,
                       Message *why);
    int32_t (*finish)(Queue *queue, Message *why);
};

} // namespace locus::device

#define LOCUS_DEVICE_ENTRY_OF_(major, minor, patch) locus_cuda_##major##_##minor##_##patch
#define LOCUS_DEVICE_ENTRY_OF(major, minor, patch) LOCUS_DEVICE_ENTRY_OF_(major, minor, patch)
#define LOCUS_DEVICE_ENTRY LOCUS_DEVICE_ENTRY_OF(LOCUS_VERSION_MAJOR, LOCUS_VERSION_MINOR, LOCUS_VERSION_PATCH)

extern "C" LOCUS_API const locus::device::Table *LOCUS_DEVICE_ENTRY(void) LOCUS_NOEXCEPT;
