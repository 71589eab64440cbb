// Descending the quadtree level by level.
#include "pmq/query/cover.hpp"

namespace locus::pmq {
namespace {

struct Piece {
    Quadrant quadrant;
    Relation relation; // not outside
};

bool joins(const locus_key_range &before, const locus_key_range &next) noexcept {
    return before.last + 1 == next.first && before.inside == next.inside;
}

// Neighbours of one kind merged; false when that leaves more than `most`.
bool merge(const std::vector<Piece> &pieces, size_t most, std::vector<locus_key_range> &ranges) {
    ranges.clear();
    for (const Piece &piece : pieces) {
        const KeyRange keys = piece.quadrant.keys();
        const locus_key_range next{keys.lo, keys.hi - 1, piece.relation == Relation::inside, 0};
        if (!ranges.empty() && joins(ranges.back(), next))
            ranges.back().last = next.last;
        else if (ranges.size() == most)
            return false;
        else
            ranges.push_back(next);
    }
    return true;
}

// One level deeper, where the border runs; false when nothing is left to be divided.
bool divide(const Region &region, const std::vector<Piece> &pieces, std::vector<Piece> &finer) {
    bool divided = false;
    finer.clear();
    for (const Piece &piece : pieces) {
        if (piece.relation == Relation::inside || piece.quadrant.level == key_levels) {
            finer.push_back(piece);
            continue;
        }
        divided = true;
        for (unsigned number = 0; number < 4; ++number) {
            const Quadrant child = piece.quadrant.child(number);
            if (const Relation relation = region.relate(child); relation != Relation::outside)
                finer.push_back({child, relation});
        }
    }
    return divided;
}

} // namespace

std::vector<locus_key_range> cover(const Region *region, size_t most) {
    std::vector<Piece> pieces{{{}, region ? region->relate(Quadrant{}) : Relation::inside}}, finer;
    if (pieces[0].relation == Relation::outside)
        return {};
    std::vector<locus_key_range> ranges, closer;
    merge(pieces, most, ranges);
    while (region && divide(*region, pieces, finer) && merge(finer, most, closer)) {
        pieces.swap(finer);
        ranges.swap(closer);
    }
    return ranges;
}

} // namespace locus::pmq
