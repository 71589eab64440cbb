// Sparse rows of weights: what is left of a row after normalising and pruning, and all rows together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace locus::graph {

// The weight of one seed, named by its label, in one row.
struct Share {
    uint32_t label;
    float weight;
    bool operator==(const Share &) const = default;
};

// A row as the methods build it: any order, not normalised, labels unique.
struct RawShare {
    uint32_t label;
    double weight;
};

// Sort by falling weight (rising label on ties), keep the `most` largest (0: all), drop zeros, and scale to sum 1.
// `row` is scratch and is reordered; the result is appended to `out`.
void finish_row(std::vector<RawShare> &row, uint32_t most, std::vector<Share> &out);

// Rows one after the other.
struct Rows {
    std::vector<uint64_t> offsets{0}; // one more than there are rows
    std::vector<Share> shares;

    uint64_t count() const { return offsets.size() - 1; }
    std::span<const Share> row(uint64_t i) const {
        return {shares.data() + offsets[i], shares.data() + offsets[i + 1]};
    }
};

inline void add_row(Rows &rows, std::span<const Share> row) {
    rows.shares.insert(rows.shares.end(), row.begin(), row.end());
    rows.offsets.push_back(rows.shares.size());
}

// Some rows computed by one thread: where each belongs, and its end in `shares`.
struct RowPile {
    std::vector<uint64_t> place;
    std::vector<uint64_t> begin; // in `shares`, where rows do not lie one after the other; else empty
    std::vector<uint64_t> end;
    std::vector<Share> shares;

    void close(uint64_t row) {
        place.push_back(row);
        end.push_back(shares.size());
    }
};

// Put the rows of the piles into order. A row in several piles, from a task that was begun and given back, is the same
// in each; rows in no pile come from `base` where given, and are empty otherwise.
Rows assemble(uint64_t count, std::span<const RowPile> piles, const Rows *base = nullptr);

} // namespace locus::graph
