#include "tests/emulated/device.hpp"

#include "graph/device/dispatch.hpp"
#include "tests/emulated/lanes.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

namespace locus::device {

struct Queue {
    std::mt19937_64 random;
    void *stream = nullptr;
};

namespace emulated {

Settings &settings() {
    static Settings settings;
    return settings;
}
Counters &counters() {
    static Counters counters;
    return counters;
}

namespace {

int32_t say(Message *why, int32_t status, const char *text) {
    std::snprintf(why->text, sizeof why->text, "%s", text);
    return status;
}

bool fails(Message *why, int32_t &status) {
    int64_t &left = settings().calls_left;
    if (left < 0 || left-- > 0)
        return false;
    if (settings().keeps_failing)
        left = 0;
    status = say(why, settings().failure, "the emulated device was told to fail");
    return true;
}

// The numbers 0..count-1 in some order.
class Order {
public:
    Order(uint64_t count, std::mt19937_64 &random) : count_(count), start_(count > 0 ? random() % count : 0) {
        constexpr uint64_t primes[] = {1, 0, 7919, 104729, 15485863, 32452843};
        step_ = count > 0 ? primes[random() % std::size(primes)] % count : 0;
        if (step_ == 0)
            step_ = count > 0 ? count - 1 : 0; // downwards
        while (count > 1 && std::gcd(step_, count) != 1)
            ++step_;
        if (count == 1)
            step_ = 0;
    }
    uint64_t operator[](uint64_t i) const {
        return static_cast<uint64_t>((__extension__ static_cast<unsigned __int128>(i) * step_ + start_) % count_);
    }

private:
    uint64_t count_, start_, step_;
};

// Runs share(rank, of) on the threads asked for.
template <typename Share>
void on_threads(Share &&share) {
    const uint32_t threads = settings().threads;
    std::vector<std::thread> others;
    for (uint32_t rank = 1; rank < threads; ++rank)
        others.emplace_back([&, rank] { share(rank, threads); });
    share(0u, threads);
    for (std::thread &thread : others)
        thread.join();
}

template <typename Body>
class Block {
public:
    Block(uint64_t index, uint64_t memory, uint64_t seed)
        : shared(*fresh<typename Body::Shared>(shared_)), index_(index), memory_(memory), random_(seed) {
        std::memset(static_cast<void *>(locals_), 0xA5, sizeof locals_);
    }
    uint64_t index() const { return index_; }
    unsigned char *memory() { return memory_.get(); }
    template <typename Phase>
    void each(Phase &&phase) {
        const Order order(Body::threads, random_);
        for (unsigned i = 0; i < Body::threads; ++i) {
            const auto thread = static_cast<unsigned>(order[i]);
            phase(thread, locals_[thread]);
        }
    }

private:
    template <typename Shared>
    static Shared *fresh(unsigned char *memory) {
        std::memset(memory, 0xA5, sizeof(Shared));
        return reinterpret_cast<Shared *>(memory);
    }
    alignas(64) unsigned char shared_[sizeof(typename Body::Shared)];
    typename Body::Local locals_[Body::threads];

public:
    typename Body::Shared &shared;

private:
    uint64_t index_;
    BlockMemory memory_;
    std::mt19937_64 random_;
};

struct Runner {
    Queue &queue;
    Message *why;
    bool asked = false; // only how many blocks

    template <typename Body>
    int32_t check(const Launch &launch) const {
        return launch.body_bytes == sizeof(Body) ? LOCUS_OK : say(why, LOCUS_E_INTERNAL, "a body of another kernel");
    }
    template <typename Body>
    int32_t items(const Launch &launch) {
        if (const int32_t status = check<Body>(launch); status != LOCUS_OK || asked)
            return status;
        const Body body = *static_cast<const Body *>(launch.body);
        const uint64_t count = body.count();
        if (count > launch.items)
            return say(why, LOCUS_E_INTERNAL, "a kernel has more items than it was launched for");
        counters().items += count;
        const Order order(count, queue.random);
        on_threads([&](uint64_t rank, uint64_t of) {
            for (uint64_t i = rank; i < count; i += of)
                body(order[i]);
        });
        return LOCUS_OK;
    }
    template <typename Body>
    int32_t blocks(const Launch &launch) {
        if (const int32_t status = check<Body>(launch); status != LOCUS_OK || asked)
            return status;
        const Body body = *static_cast<const Body *>(launch.body);
        if (launch.memory > settings().block_memory)
            return say(why, LOCUS_E_INTERNAL, "a block wants more memory than it may have");
        const Order order(launch.items, queue.random);
        const uint64_t seed = queue.random();
        std::atomic<bool> together = true;
        on_threads([&](uint64_t rank, uint64_t of) {
            for (uint64_t i = rank; i < launch.items; i += of) {
                if (settings().lanes > 0) {
                    if (!run_lanes(body, order[i], settings().lanes, seed + i, launch.memory))
                        together = false;
                    continue;
                }
                const auto block = std::make_unique<Block<Body>>(order[i], launch.memory, seed + i);
                body(*block);
            }
        });
        return together ? LOCUS_OK : say(why, LOCUS_E_INTERNAL, "threads of a block came to different barriers");
    }
};

int32_t run(Runner &runner, const Launch &launch) {
    switch (launch.kernel) {
    case Kernel::lower:
        return run_visit<false>(runner, launch);
    case Kernel::raise:
        return run_visit<true>(runner, launch);
    case Kernel::relax:
        return run_relax(runner, launch);
    case Kernel::sibson:
    case Kernel::sibson_large:
        return run_sibson(runner, launch);
    default:
        return run_plain(runner, launch);
    }
}

int32_t open(Queue **queue, Machine *machine, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    *queue = new Queue{std::mt19937_64(settings().seed), nullptr};
    *machine = Machine{"emulated", settings().memory, 1, 0, settings().block_memory, 2 * settings().block_memory};
    return LOCUS_OK;
}

void close(Queue *queue) { delete queue; }

int32_t use_stream(Queue *queue, void *stream, Message *why) {
    int32_t status = LOCUS_OK;
    if (!fails(why, status))
        queue->stream = stream;
    return status;
}

// The size stands in front of the memory, which is rubbish at first.
constexpr size_t head = 64;

int32_t allocate(Queue *, uint64_t bytes, void **memory, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    if (bytes > settings().memory || counters().allocated > settings().memory - bytes)
        return say(why, LOCUS_E_MEMORY, "the emulated device has no more memory");
    auto *raw = static_cast<unsigned char *>(std::malloc(bytes + head));
    if (raw == nullptr)
        return say(why, LOCUS_E_MEMORY, "the host has no more memory");
    std::memcpy(raw, &bytes, sizeof bytes);
    std::memset(raw + head, 0xA5, bytes);
    counters().allocated += bytes;
    *memory = raw + head;
    return LOCUS_OK;
}

void release(Queue *, void *memory) {
    if (memory == nullptr)
        return;
    unsigned char *raw = static_cast<unsigned char *>(memory) - head;
    uint64_t bytes = 0;
    std::memcpy(&bytes, raw, sizeof bytes);
    counters().allocated -= bytes;
    std::free(raw);
}

int32_t transfer(uint64_t &counter, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    if (copy != nullptr)
        copy->run(copy->user, to, from, bytes);
    else
        std::memcpy(to, from, bytes);
    counter += bytes;
    return LOCUS_OK;
}
int32_t upload(Queue *, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why) {
    return transfer(counters().uploaded, to, from, bytes, copy, why);
}
int32_t download(Queue *, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why) {
    return transfer(counters().downloaded, to, from, bytes, copy, why);
}

int32_t writable(Queue *, const void *, Message *why) {
    int32_t status = LOCUS_OK;
    fails(why, status);
    return status;
}

int32_t launch(Queue *queue, const Launch *launched, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    if (settings().stream != nullptr && queue->stream != settings().stream)
        return say(why, LOCUS_E_INTERNAL, "a kernel was put on another stream than the caller's");
    ++counters().launches;
    Runner runner{*queue, why};
    return run(runner, *launched);
}

int32_t resident(Queue *queue, const Launch *launched, uint64_t *blocks, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    *blocks = settings().blocks;
    Runner runner{*queue, why, true};
    return run(runner, *launched);
}

int32_t compact(Queue *, const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed, Message *why) {
    int32_t status = LOCUS_OK;
    if (fails(why, status))
        return status;
    *listed = 0;
    for (uint64_t i = 0; i < count; ++i)
        if (flags[i] != 0)
            list[(*listed)++] = i;
    return LOCUS_OK;
}

int32_t finish(Queue *, Message *why) {
    int32_t status = LOCUS_OK;
    fails(why, status);
    return status;
}

} // namespace

const Table &table() {
    static const Table table{sizeof(Table), kInterface, LOCUS_VERSION, open,   close,    use_stream, allocate, release,
                             upload,        download,   writable,      launch, resident, compact,    finish};
    return table;
}

} // namespace emulated
} // namespace locus::device
