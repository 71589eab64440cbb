// Records taken over and not yet in the file, numbered in the order in which they came. One thread puts them in, one
// writes them; any number look at them.
#pragma once

#include "cold/record.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace locus::cold {

struct Entry {
    uint64_t key, number; // of a record: its place in the order (key, arrival)
    bool operator<(const Entry &other) const noexcept {
        return key != other.key ? key < other.key : number < other.number;
    }
};

class Queue {
    struct Chunk {
        Chunk(uint64_t number, size_t bytes) : first(number), memory(new std::byte[bytes]) {}
        uint64_t first;
        std::unique_ptr<std::byte[]> memory;
    };

public:
    // What is there at one moment: the records written..received - 1, of which `sorted`, if any, are in order already.
    class Content {
    public:
        uint64_t written = 0, received = 0;
        std::shared_ptr<const std::vector<Entry>> sorted;
        const std::byte *record(uint64_t number) const noexcept;

    private:
        friend class Queue;
        std::deque<std::shared_ptr<const Chunk>> chunks_;
        size_t record_size_ = 0, chunk_records_ = 1;
    };

    Queue(size_t record_size, uint64_t most_bytes, bool waits, uint64_t enough, std::chrono::microseconds delay);

    // The one who puts: take a record over. False: there is more in the queue than should be.
    bool put(const std::byte *record);
    bool refused() const noexcept { return refused_.load(); } // the latest put said false
    bool waiting() const noexcept { return waiting_.load(); } // one waits for room

    uint64_t received() const noexcept { return received_.load(std::memory_order_acquire); }
    Content content() const;
    uint64_t bytes() const;
    uint64_t waits() const;

    // The one who writes: wait for something to do, or until wake(). What is there then.
    Content wait();
    void wake();
    void sorted(std::shared_ptr<const std::vector<Entry>> entries); // of the batch at work
    void written(uint64_t end);                                     // it is in the file
    void failing(bool is);                                          // as long as it is, nobody waits for room
    void start_at(uint64_t number);                                 // when it is empty

private:
    void begin_chunk(uint64_t number);
    bool crowded() const noexcept { return chunks_.size() > most_chunks_; }

    const size_t record_size_, chunk_records_, most_chunks_;
    const bool waits_;
    const uint64_t enough_;
    const std::chrono::microseconds delay_;

    std::byte *next_ = nullptr; // the putting thread's: where the next record goes,
    uint64_t chunk_end_ = 0;    // and the number at which its chunk ends
    std::atomic<uint64_t> received_ = 0;
    std::atomic<bool> refused_ = false, waiting_ = false;

    mutable std::mutex mutex_;
    std::condition_variable room_, work_;
    std::deque<std::shared_ptr<const Chunk>> chunks_;
    std::shared_ptr<const std::vector<Entry>> sorted_;
    uint64_t written_ = 0, waited_ = 0;
    bool failing_ = false, woken_ = false, starving_ = false;
};

} // namespace locus::cold
