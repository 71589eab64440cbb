// Weights edge by edge, for rules that do not separate and for bricks with cut edges: each of the 26 neighbours' words
// plus the weight of the edge to it. Included by the same rules as pull-inl.hpp, after it.

namespace locus::bricks::LOCUS_LANES_NAMESPACE {

// The weight of the edges of class k between rows of voxels.
template <typename Word>
struct MeanWeight {
    using L = Lanes<Word>;
    using Row = typename L::Row;
    LOCUS_INLINE static Row of(const Metric<Word> &m, Row a, Row b, unsigned k) {
        return L::add(L::share(a, m.factor[k], m.low[k], m.cap, m.label_bits),
                      L::share(b, m.factor[k], m.low[k], m.cap, m.label_bits));
    }
};
template <typename Word>
struct MaxWeight {
    using L = Lanes<Word>;
    using Row = typename L::Row;
    LOCUS_INLINE static Row of(const Metric<Word> &m, Row a, Row b, unsigned k) {
        return L::share(L::larger(a, b), m.factor[k], m.low[k], m.cap, m.label_bits);
    }
};
template <typename Word>
struct StiffnessWeight {
    using L = Lanes<Word>;
    using Row = typename L::Row;
    LOCUS_INLINE static Row of(const Metric<Word> &m, Row a, Row b, unsigned k) {
        return L::quotient(L::sum(a, b), m.factor[k], m.low[k], m.cap, m.label_bits);
    }
};

template <typename Word, typename Weight>
class EdgeVisit : public PullVisit<Word, EdgeVisit<Word, Weight>> {
    using Base = PullVisit<Word, EdgeVisit<Word, Weight>>;
    using L = Lanes<Word>;
    using Row = typename L::Row;

public:
    LOCUS_INLINE explicit EdgeVisit(Visit<Word> &visit) : Base(visit) {}
    LOCUS_INLINE void prepare(unsigned) {}
    LOCUS_INLINE void stored(unsigned, Row) {}

    LOCUS_INLINE Row pull(unsigned row) const {
        const uint16_t *blocked = this->v_.blocked != nullptr ? this->v_.blocked->lanes[row] : nullptr;
        const Row to = L::operand(this->own_[row].operand);
        Row best = this->fill_;
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                best = L::min(best, from(padded(row), to, dy, dz, blocked));
        return passable(to, best);
    }

    LOCUS_INLINE Row offer(const BrickRow<Word> &there, unsigned row, int dy, int dz) const {
        const auto s = static_cast<unsigned>(static_cast<int>(padded(row)) +
                                             static_cast<int>(kSide) * (dy + static_cast<int>(kPadded) * dz));
        const Row to = L::operand(there.operand);
        Row best = this->fill_;
        for (int t = -1; t <= 1; ++t) {
            if (dy != 0 && dz != 0 && t != 0)
                continue;
            best = L::min(best, from(s, to, dy != 0 ? -dy : t, dz != 0 ? -dz : t, nullptr));
        }
        return passable(to, best);
    }

private:
    // An impassable voxel takes nothing. Infinite compliances see to that themselves, stiffnesses of zero do not.
    LOCUS_INLINE Row passable(Row to, Row best) const {
        if constexpr (std::is_same_v<Weight, StiffnessWeight<Word>>)
            return L::where_positive(to, best, this->fill_);
        return best;
    }

    // The offers to padded row s from the three neighbours in the row at (dy, dz).
    LOCUS_INLINE Row from(unsigned s, Row to, int dy, int dz, const uint16_t *blocked) const {
        const auto n = static_cast<unsigned>(static_cast<int>(s) + dy + static_cast<int>(kPadded) * dz);
        const BrickRow<Word> &row = this->row_at(n % kPadded, n / kPadded);
        const Row word = L::load(row.word);
        const Row operand = L::operand(row.operand);
        const unsigned k = (dy != 0 ? 2u : 0u) | (dz != 0 ? 4u : 0u);
        const unsigned middle = neighbour_number(0, dy, dz);
        Row best = offered(L::left(word, this->fill_), L::left(operand, operand), to, k | 1u, middle - 1, blocked);
        best = L::min(
            best, offered(L::right(word, this->fill_), L::right(operand, operand), to, k | 1u, middle + 1, blocked));
        if (k != 0)
            best = L::min(best, offered(word, operand, to, k, middle, blocked));
        return best;
    }

    LOCUS_INLINE Row offered(Row word, Row operand, Row to, unsigned k, unsigned number,
                             const uint16_t *blocked) const {
        const Row sum = L::add(word, Weight::of(this->m_, operand, to, k));
        if (blocked == nullptr || blocked[number] == 0)
            return sum;
        return L::blocked(sum, blocked[number], this->fill_);
    }
};

template <typename Word, typename Weight>
void visit_edges(Visit<Word> &visit) {
    EdgeVisit<Word, Weight>(visit).run();
}

template <typename Word>
inline constexpr EdgeKernels<Word> edge_table = {
    visit_edges<Word, MeanWeight<Word>>, visit_edges<Word, MaxWeight<Word>>, visit_edges<Word, StiffnessWeight<Word>>};

} // namespace locus::bricks::LOCUS_LANES_NAMESPACE
