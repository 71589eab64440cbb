// Fences and the index over them: each is covered by a few quadrants, and a record looks for the quadrants that it lies
// in, one look per level in use.
#pragma once

#include "pmq/query/selection.hpp"

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace locus::pmq {

struct Fence {
    uint64_t id;
    std::unique_ptr<const Region> region; // nullptr: everywhere
    Selection selection;                  // with that region
    std::vector<Quadrant> cover;
    std::atomic<bool> removed = false;
};

class Fences {
public:
    // Both throw Error(LOCUS_E_ARGUMENT): the id is in use, or is not.
    void add(uint64_t id, std::unique_ptr<const Region> region, const Selection &selection);
    void remove(uint64_t id);

    // Append the fences whose region and time window hold a record, by rising id. Their filters are not asked.
    using Found = std::vector<std::shared_ptr<const Fence>>;
    void find(uint64_t key, Bytes record, const RecordFormat &format, Found &found) const;

    bool empty() const noexcept { return fences_.empty(); }
    size_t size() const noexcept { return fences_.size(); }
    uint64_t bytes() const noexcept;

private:
    struct Entry {
        std::shared_ptr<const Fence> fence;
        bool inside; // the whole quadrant
    };
    static std::vector<std::pair<Quadrant, bool>> cover_of(const Region *region);
    static uint64_t name(const Quadrant &quadrant) noexcept {
        return uint64_t{1} << 2 * quadrant.level | quadrant.code;
    }
    void drop_cell(const Fence &fence, const Quadrant &quadrant) noexcept;

    std::unordered_map<uint64_t, std::shared_ptr<Fence>> fences_;
    std::unordered_map<uint64_t, std::vector<Entry>> cells_; // by the quadrant's name
    std::array<size_t, key_levels + 1> cells_at_{};          // how many of each level
    size_t entries_ = 0;
};

} // namespace locus::pmq
