// Which brick is visited next, and by which thread. Bricks wait in a heap by (smallest word that reaches them / width,
// order of arrival): near enough to Dijkstra's order that few are visited in vain, coarse enough that a visit has much
// to do. Every thread has a slab of the grid and the heap of its bricks, so that these stay in its core's cache, and
// takes from another one where its own is empty or far ahead. A brick is taken only while no adjacent one is being
// visited: a visit reads and writes nothing beyond its neighbours, so no two visits touch the same memory.
#pragma once

#include "core/spin.hpp"
#include "graph/bricks/store.hpp"
#include "graph/bricks/visit.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

namespace locus::bricks {

template <typename Word>
class Schedule {
public:
    // Keys are told apart down to 2^width_bits, or by their highest bit where that is wider than a word.
    Schedule(const Store<Word> &store, unsigned width_bits)
        : store_(store), width_bits_(std::min<unsigned>(width_bits, std::numeric_limits<Word>::digits - 1)),
          state_(store.layout().count()) {}

    // Before each run. What add() was given since the last run stays; a run that was stopped leaves a schedule that
    // must not be used again.
    void begin(unsigned threads) {
        slot_.assign(threads, Slot{});
        seen_ = 0;
        ++run_;
        std::vector<Heap> before(threads);
        before.swap(heap_);
        for (const Heap &heap : before)
            for (const Entry &entry : heap)
                push(entry);
    }

    struct Work {
        RowMask active = 0, changed = 0, changed_first = 0, changed_last = 0;
    };
    struct Taken {
        size_t brick;
        Place place;
        Work work;
    };

    // Rows of a brick to look at, and rows of it that have changed already. Before the team starts, or under the lock.
    void add(size_t brick, const Work &work, Word key) {
        State &s = state_[brick];
        s.work.active |= work.active;
        s.work.changed |= work.changed;
        s.work.changed_first |= work.changed_first;
        s.work.changed_last |= work.changed_last;
        const uint64_t bucket = key >> width_bits_;
        if (bucket >= s.bucket)
            return;
        s.bucket = bucket;
        push({bucket, arrivals_++, static_cast<uint32_t>(brick)});
    }

    // End the visit of `done`, if there was one, waking what it reached, and take the next brick; none when all is at
    // rest.
    std::optional<Taken> next(unsigned thread, const Taken *done, const Visit<Word> *visit) {
        auto lock = lock_soon(mutex_);
        if (done != nullptr)
            publish(thread, *done, *visit);
        for (;;) {
            if (stopped_)
                return std::nullopt;
            if (auto taken = take(thread)) {
                if (idle_ > 0 && waits())
                    tell(false);
                return taken;
            }
            if (running_ == 0) {
                tell(true);
                return std::nullopt;
            }
            ++idle_;
            wait(lock);
            --idle_;
        }
    }

    // Make every thread's next() return none: a visit has failed or the caller stops.
    void stop() {
        const auto lock = lock_soon(mutex_);
        stopped_ = true;
        tell(true);
    }

    size_t bytes() const {
        size_t entries = 0;
        for (const Heap &heap : heap_)
            entries += heap.capacity();
        return state_.capacity() * sizeof(State) + entries * sizeof(Entry);
    }
    // Part of the bricks that have been visited; any thread may ask.
    double fraction() const {
        return static_cast<double>(seen_.load(std::memory_order_relaxed)) / static_cast<double>(state_.size());
    }

private:
    static constexpr uint64_t kNotQueued = std::numeric_limits<uint64_t>::max();
    static constexpr uint64_t kPatience = 2; // buckets that a thread's own bricks may come after another's
    struct State {
        Work work;
        uint64_t bucket = kNotQueued;
        uint64_t seen = 0; // the latest run that visited it
    };
    struct Entry {
        uint64_t bucket, arrival;
        uint32_t brick;
        bool operator<(const Entry &other) const { // std::push_heap keeps the largest on top
            return bucket != other.bucket ? bucket > other.bucket : arrival > other.arrival;
        }
    };
    using Heap = std::vector<Entry>;
    // What a thread is visiting, and the entries that had to wait for it.
    struct Slot {
        bool busy = false;
        Place place;
        std::vector<Entry> waiting;
    };

    // There may be something to do for one of the waiting threads, or for all; under the lock. A visit takes
    // microseconds: who waits asks for news a while before it sleeps.
    void tell(bool all) {
        news_.fetch_add(1, std::memory_order_release);
        if (asleep_ > 0)
            all ? changed_.notify_all() : changed_.notify_one();
    }
    void wait(std::unique_lock<std::mutex> &lock) {
        const uint32_t before = news_.load(std::memory_order_relaxed);
        lock.unlock();
        const bool told = spin_until([&] { return news_.load(std::memory_order_acquire) != before; });
        lock = lock_soon(mutex_);
        if (told || news_.load(std::memory_order_relaxed) != before)
            return;
        ++asleep_;
        changed_.wait(lock);
        --asleep_;
    }

    Heap &heap_of(size_t brick) { return heap_[brick * heap_.size() / state_.size()]; }
    bool waits() const {
        return std::any_of(heap_.begin(), heap_.end(), [](const Heap &heap) { return !heap.empty(); });
    }
    void push(const Entry &entry) {
        Heap &heap = heap_of(entry.brick);
        heap.push_back(entry);
        std::push_heap(heap.begin(), heap.end());
    }
    // The heap that a thread takes from: its own, unless another one's first brick is due long before; null when all
    // are empty.
    Heap *due(unsigned thread) {
        Heap *first = nullptr;
        for (Heap &heap : heap_)
            if (!heap.empty() && (first == nullptr || heap.front().bucket < first->front().bucket))
                first = &heap;
        Heap &own = heap_[thread];
        return !own.empty() && own.front().bucket <= first->front().bucket + kPatience ? &own : first;
    }

    std::optional<Taken> take(unsigned thread) {
        while (Heap *heap = due(thread)) {
            std::pop_heap(heap->begin(), heap->end());
            const Entry entry = heap->back();
            heap->pop_back();
            State &s = state_[entry.brick];
            if (s.bucket != entry.bucket)
                continue; // a smaller key has taken its place
            const Place place = store_.place(entry.brick);
            if (Slot *neighbour = adjacent_visit(place)) {
                neighbour->waiting.push_back(entry);
                continue;
            }
            const Taken taken{entry.brick, place, s.work};
            if (s.seen != run_)
                seen_.fetch_add(1, std::memory_order_relaxed);
            s = State{.work = {}, .bucket = kNotQueued, .seen = run_};
            slot_[thread].busy = true;
            slot_[thread].place = place;
            ++running_;
            return taken;
        }
        return std::nullopt;
    }

    Slot *adjacent_visit(const Place &place) {
        for (Slot &slot : slot_)
            if (slot.busy && adjacent(slot.place, place))
                return &slot;
        return nullptr;
    }

    void publish(unsigned thread, const Taken &done, const Visit<Word> &visit) {
        unsigned number = 0;
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx, ++number) {
                    const Wake<Word> &wake = visit.wake[number];
                    if (wake.rows == 0)
                        continue;
                    const size_t brick = store_.at({done.place.x + dx, done.place.y + dy, done.place.z + dz});
                    if (brick != store_.outside())
                        add(brick, Work{wake.rows}, wake.key);
                }
        Slot &slot = slot_[thread];
        for (const Entry &entry : slot.waiting)
            push(entry);
        slot.waiting.clear();
        slot.busy = false;
        --running_;
    }

    const Store<Word> &store_;
    unsigned width_bits_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<State> state_;
    std::vector<Slot> slot_;
    std::vector<Heap> heap_{1}; // by thread
    uint64_t arrivals_ = 0, run_ = 0;
    std::atomic<uint64_t> seen_{0};
    std::atomic<uint32_t> news_{0};
    unsigned running_ = 0, idle_ = 0, asleep_ = 0;
    bool stopped_ = false;
};

} // namespace locus::bricks
