// Where leaves live: slabs of up to 8 MB on huge pages, touched ahead of use a step at a time, so that no batch pays
// for a whole slab's first touch, and given back when few of their leaves are in use.
#pragma once

#include "pmq/layout/ring_leaf.hpp"

#include <memory>
#include <vector>

namespace locus::pmq {

class Slabs {
public:
    // Where memory is limited, slabs are small beside the limit.
    Slabs(size_t leaf_bytes, uint64_t limit);
    ~Slabs();
    Slabs(const Slabs &) = delete;
    Slabs &operator=(const Slabs &) = delete;

    LeafMemory take(); // throws std::bad_alloc
    void give_back(LeafMemory leaf) noexcept;

    // Once per batch, sweep or erasure: touch the next step of what will be needed soon; choose a slab to be vacated or
    // unmap vacated ones.
    void prepare() noexcept;
    // The leaf lies in a slab that is being vacated: its records should move.
    bool vacating(LeafMemory leaf) const noexcept;
    bool any_vacating() const noexcept { return vacating_ != nullptr; }

    // Is there room for the times of leaves (LeafShape::times)?
    bool keep_times() const noexcept;

    // Under pressure no free leaf is worth keeping.
    void press(bool pressed) noexcept { pressed_ = pressed; }

    size_t leaves() const noexcept { return used_; }
    size_t capacity() const noexcept { return capacity_; }
    uint64_t bytes() const noexcept { return bytes_; }
    uint64_t mapped() const noexcept { return mapped_; } // slabs, ever
    uint64_t unmapped() const noexcept { return mapped_ - slabs_.size(); }

private:
    struct Slab {
        std::byte *base = nullptr;
        size_t bytes = 0, leaves = 0, used = 0;
        size_t lead = 0;    // bytes before the first leaf, for times
        size_t fresh = 0;   // leaves from here on have never been used
        size_t touched = 0; // bytes from the base on that have been touched
        std::vector<uint16_t> free;
        bool full() const noexcept { return used == leaves; }
    };

    Slab &add_slab();
    Slab *with_room() noexcept;
    Slab *slab_of(LeafMemory leaf) const noexcept;
    void touch(Slab &slab, size_t bytes) noexcept;
    size_t slack() const noexcept;
    void choose_vacating() noexcept;
    void release_empty() noexcept;
    void unmap(size_t index) noexcept;

    size_t leaf_bytes_;
    size_t smallest_slab_, largest_slab_;
    bool limited_, pressed_ = false;
    std::vector<std::unique_ptr<Slab>> slabs_; // by address
    Slab *current_ = nullptr;                  // the last one taken from
    Slab *vacating_ = nullptr;
    size_t used_ = 0, capacity_ = 0;
    uint64_t bytes_ = 0, mapped_ = 0;
};

} // namespace locus::pmq
