// A monotone bucket queue: keys come out in ascending order, and none goes in below the last that came out. Multi-level
// buckets (Denardo and Fox 1979; Cherkassky, Goldberg, Radzik 1996): a key lies on the level of the highest 6-bit digit
// in which it differs from the last key that came out, in the bucket of that digit. While keys stay within 64 of each
// other that is Dial's ring of buckets; keys of 64 bits need no more than 11 levels.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace locus::graph {

template <typename Item>
class BucketQueue {
public:
    // `key` is not below last().
    void push(uint64_t key, Item item) {
        const unsigned level = level_of(key);
        const unsigned digit = digit_of(key, level);
        std::vector<Item> &bucket = buckets_[level][digit];
        if (bucket.capacity() == 0 && !spare_.empty()) {
            bucket.swap(spare_.back());
            spare_.pop_back();
        }
        bucket.push_back(item);
        filled_[level] |= uint64_t{1} << digit;
    }

    // Take the items of the smallest key into `items` and make it the last; false when the queue is empty. key_of(item)
    // gives an item's key now: items whose key has become smaller than they were pushed with are dropped, or come out
    // together with the items of that smaller key.
    template <typename KeyOf>
    bool pop(std::vector<Item> &items, KeyOf &&key_of) {
        items.clear();
        for (;;) {
            unsigned level = 0;
            while (level < levels && filled_[level] == 0)
                ++level;
            if (level == levels)
                return false;
            const auto digit = static_cast<unsigned>(std::countr_zero(filled_[level]));
            filled_[level] &= filled_[level] - 1;
            last_ = first_key(level, digit);
            std::vector<Item> &bucket = buckets_[level][digit];
            if (level == 0) {
                items.swap(bucket);
                recycle(bucket);
                return true;
            }
            // Nothing lies below this level: spread the bucket's items over the levels below, then look again.
            std::vector<Item> coarse;
            coarse.swap(bucket);
            for (const Item item : coarse)
                if (const uint64_t key = key_of(item); key >= last_)
                    push(key, item);
            recycle(coarse);
        }
    }

    uint64_t last() const { return last_; }

    // Begin again with keys from 0 on; the queue must be empty.
    void rewind() { last_ = 0; }

private:
    static constexpr unsigned levels = 11;

    unsigned level_of(uint64_t key) const {
        return key == last_ ? 0 : static_cast<unsigned>(std::bit_width(key ^ last_) - 1) / 6;
    }
    static unsigned digit_of(uint64_t key, unsigned level) { return static_cast<unsigned>(key >> (6 * level)) & 63; }
    uint64_t first_key(unsigned level, unsigned digit) const {
        const unsigned above = 6 * (level + 1);
        const uint64_t kept = above < 64 ? last_ >> above << above : 0;
        return kept | uint64_t{digit} << (6 * level);
    }
    // Emptied buckets hand their memory on, so that the queue holds little more than the front.
    void recycle(std::vector<Item> &bucket) {
        if (bucket.capacity() == 0)
            return;
        bucket.clear();
        spare_.push_back(std::move(bucket));
        bucket = {};
    }

    std::array<std::array<std::vector<Item>, 64>, levels> buckets_;
    std::array<uint64_t, levels> filled_{};
    std::vector<std::vector<Item>> spare_;
    uint64_t last_ = 0;
};

} // namespace locus::graph
