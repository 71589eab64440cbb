// One query's search by itself: a bounded Dijkstra over little more than the voxels that it steals.
#pragma once

#include "graph/bucket_queue.hpp"
#include "graph/weights/field.hpp"

#include <array>
#include <vector>

namespace locus::graph {

// For queries too few to share a window, and for objects so thin that a window is mostly empty. The grid is copied page
// by page where the search gets to, so that neither time nor memory depends on its size.
template <typename Word>
class LoneSearch {
public:
    explicit LoneSearch(const Field &field);

    // Find the voxels v with d(query, v) < D(v); `query` is reached, at a distance above 0. False where they take more
    // than `most_bytes`: then nothing is found, and bytes_needed() were not yet enough.
    bool steal(uint64_t query, uint64_t most_bytes);
    uint64_t bytes_needed() const { return needed_; }
    // Whether that query was the last, and is found.
    bool found(uint64_t query) const { return !stolen_.empty() && stolen_.front().voxel == query; }
    uint64_t bytes() const;

    struct Stolen {
        uint64_t voxel;
        Word distance;
        uint32_t place;
    };
    // The query first.
    const std::vector<Stolen> &stolen() const { return stolen_; }
    // min(d(query, v), D(v)) of a stolen voxel's neighbour, which is one of the graph.
    Word reach_beside(const Stolen &stolen, unsigned number) const { return reach(beside(stolen.place, number)); }
    // The box around them.
    Box box() const;

    const Field &field() const { return field_; }

private:
    static constexpr unsigned page_bits = 4, page_size = 1u << page_bits;
    static constexpr uint32_t outside = 0; // the page beyond the grid, where nothing can be stolen
    static constexpr uint32_t unknown = UINT32_MAX;

    // Voxels in a row. A place is a page and a voxel in it.
    struct Page {
        std::array<Word, page_size> reach{}; // min(d, D); 0 where nothing can be stolen
        std::array<uint32_t, 27> around{};   // the pages beside it, like a voxel's neighbours, itself in the middle
        uint64_t number = 0;                 // in raster order
        uint16_t settled = 0;
    };
    struct Slot {
        uint32_t search = 0; // the one that filled it
        uint32_t page = 0;
    };
    struct Hop {
        int dx;
        unsigned row; // in Page::around: the pages before, at and after the same x stand there
    };

    static uint32_t place_of(uint32_t page, uint32_t x) { return page << page_bits | x; }
    uint32_t beside(uint32_t place, unsigned number) const;
    Word reach(uint32_t place) const { return pages_[place >> page_bits].reach[place % page_size]; }
    uint64_t key_of(uint32_t place) const;
    uint64_t first_voxel(uint64_t number) const {
        return number % pages_along_x_ * page_size + number / pages_along_x_ * field_.grid().nx();
    }
    uint32_t page_at(uint64_t number);
    void meet_pages(uint32_t page, unsigned side);
    size_t slot_of(uint64_t number) const;
    void grow_table();
    void clear();
    void settle(uint32_t place);
    void relax(const Stolen &from);

    const Field &field_;
    uint64_t smallest_; // no edge weighs less
    uint32_t shift_;    // nothing within 2^shift_ of a voxel's distance improves it
    uint64_t pages_along_x_;
    std::array<Hop, 26> hops_;
    std::vector<Page> pages_;
    std::vector<Slot> table_; // open addressing, at most half full
    uint32_t search_ = 0;
    uint64_t needed_ = 0;
    std::vector<Stolen> stolen_;
    BucketQueue<uint32_t> queue_;
    std::vector<uint32_t> bucket_;
};

extern template class LoneSearch<uint32_t>;
extern template class LoneSearch<uint64_t>;

} // namespace locus::graph
