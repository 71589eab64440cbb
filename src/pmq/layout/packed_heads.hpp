// The search index over the heads of segments: a copy of them side by side, and above it levels of samples, each
// holding every 16th key of the one below. A search comes down from the top through one group of 16 keys a level, two
// cache lines, where halving over the array would touch a line of its own for each step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::pmq {

class Heads {
public:
    Heads() = default;
    explicit Heads(size_t segments); // of 0 segments: absent
    static size_t bytes(size_t segments) noexcept;

    bool present() const noexcept { return !levels_.empty(); }
    uint64_t operator[](size_t segment) const noexcept { return levels_.front()[segment]; }
    void set(size_t segment, uint64_t head) noexcept { levels_.front()[segment] = head; }
    // Renew the samples above segments whose heads were set.
    void renew(size_t first, size_t segments) noexcept;

    // The last segment whose head is below `key`; the first where there is none.
    size_t find_below(uint64_t key) const noexcept;
    // Every sample is the key that it is a sample of.
    bool consistent() const noexcept;

private:
    static constexpr size_t step = 16;
    std::vector<std::vector<uint64_t>> levels_; // the heads, every 16th of them, every 256th, ...
};

} // namespace locus::pmq
