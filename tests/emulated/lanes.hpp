// A block as a GPU runs it: its threads are dealt out to lanes, threads of the host that go through the body by
// themselves, as warps do, and wait for each other only at the barriers. Nothing else orders what threads of different
// lanes do, so that the thread sanitizer sees what races within a phase, and a decision between two phases that reads
// what the next one writes.
#pragma once

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <random>
#include <thread>
#include <type_traits>
#include <vector>

namespace locus::device::emulated {

// Where the lanes of a block wait for each other. Each says where it is, by an address; null: it left the body.
class Meeting {
public:
    explicit Meeting(unsigned lanes) : at_{std::vector<const void *>(lanes), std::vector<const void *>(lanes)} {
        pthread_barrier_init(&barrier_, nullptr, lanes);
    }
    ~Meeting() { pthread_barrier_destroy(&barrier_); }
    Meeting(const Meeting &) = delete;
    Meeting &operator=(const Meeting &) = delete;

    // `turn`: how often this lane has waited. Returns whether all were at the same place.
    bool wait(unsigned lane, uint64_t turn, const void *place) {
        std::vector<const void *> &at = at_[turn % 2]; // nobody writes there before all have met once more
        at[lane] = place;
        pthread_barrier_wait(&barrier_);
        for (const void *other : at)
            if (other != place)
                return false;
        return true;
    }

private:
    pthread_barrier_t barrier_;
    std::array<std::vector<const void *>, 2> at_;
};

// What Launch::memory asks for: rubbish at first.
class BlockMemory {
public:
    explicit BlockMemory(uint64_t bytes) : bytes_(bytes / sizeof bytes_[0] + 1) {
        std::memset(bytes_.data(), 0xA5, bytes_.size() * sizeof bytes_[0]);
    }
    unsigned char *get() { return bytes_[0].data; }

private:
    struct alignas(16) Piece {
        unsigned char data[16];
    };
    std::vector<Piece> bytes_;
};

template <typename Body>
class Lane {
public:
    Lane(Meeting &meeting, std::atomic<bool> &apart, typename Body::Shared &shared_by_all, BlockMemory &memory,
         uint64_t index, unsigned number, std::vector<unsigned> threads)
        : shared(shared_by_all), meeting_(meeting), apart_(apart), memory_(memory), index_(index), number_(number),
          threads_(std::move(threads)), locals_(threads_.size()) {
        std::memset(static_cast<void *>(locals_.data()), 0xA5, locals_.size() * sizeof locals_[0]);
    }

    typename Body::Shared &shared;
    uint64_t index() const { return index_; }
    unsigned char *memory() { return memory_.get(); }
    unsigned number() const { return number_; } // for tests of the lanes: a GPU's blocks have none
    template <typename Phase>
    void each(Phase &&phase) {
        for (size_t i = 0; i < threads_.size(); ++i)
            phase(threads_[i], locals_[i]);
        meet(&place<std::remove_reference_t<Phase>>);
    }
    // After the body: until the others have left it too.
    void leave() {
        while (!meet(nullptr)) {
        }
    }

private:
    template <typename Phase>
    static constexpr char place = 0; // one for each phase of a body

    bool meet(const void *where) {
        const bool together = meeting_.wait(number_, turn_++, where);
        if (!together)
            apart_ = true;
        return together;
    }

    Meeting &meeting_;
    std::atomic<bool> &apart_;
    BlockMemory &memory_;
    uint64_t index_, turn_ = 0;
    unsigned number_;
    std::vector<unsigned> threads_;
    std::vector<typename Body::Local> locals_;
};

// Run one block, its threads in an order that `seed` tells. Returns whether the lanes always came to the same barriers.
template <typename Body>
bool run_lanes(const Body &body, uint64_t index, unsigned lanes, uint64_t seed, uint64_t bytes = 0) {
    struct alignas(64) Memory {
        unsigned char bytes[sizeof(typename Body::Shared)];
    };
    const auto memory = std::make_unique<Memory>();
    std::memset(memory->bytes, 0xA5, sizeof memory->bytes);
    auto &shared = *reinterpret_cast<typename Body::Shared *>(memory->bytes);
    BlockMemory more(bytes);
    std::vector<unsigned> order(Body::threads);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
    Meeting meeting(lanes);
    std::atomic<bool> apart = false;
    std::vector<std::thread> running;
    for (unsigned number = 0; number < lanes; ++number) {
        std::vector<unsigned> threads;
        for (size_t i = number; i < order.size(); i += lanes)
            threads.push_back(order[i]);
        running.emplace_back([&, number, threads] {
            Lane<Body> lane(meeting, apart, shared, more, index, number, threads);
            body(lane);
            lane.leave();
        });
    }
    for (std::thread &lane : running)
        lane.join();
    return !apart;
}

} // namespace locus::device::emulated
