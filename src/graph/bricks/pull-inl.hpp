// The visit of a brick by pulling: a row takes the smallest of its own words and what its 26 neighbours offer, sixteen
// voxels at a time. What a neighbour offers is the business of `Rule` (mean-inl.hpp, edge-inl.hpp). Compiled once per
// instruction set over its row operations `Lanes`, in its own namespace; hence no include guard and no includes of the
// standard library.

namespace locus::bricks::LOCUS_LANES_NAMESPACE {

inline constexpr unsigned kPadded = kSide + 2; // rows of a brick and its neighbours' border rows, in y and in z

constexpr unsigned padded(unsigned row) { return row % kSide + 1 + kPadded * (row / kSide + 1); }

template <typename Word, typename Rule>
class PullVisit {
    using L = Lanes<Word>;
    using Row = typename L::Row;

public:
    LOCUS_INLINE void run() {
        // Alternating directions carry a change far within one pass, whichever way it goes.
        for (bool up = true; v_.active != 0; up = !up)
            up ? ascend() : descend();
        v_.raise ? wake_all_around() : reach_out();
    }

protected:
    LOCUS_INLINE explicit PullVisit(Visit<Word> &visit)
        : v_(visit), m_(*visit.metric), own_(visit.around[4]->row), fill_(L::all(m_.infinity)) {}

    // Row (py, pz) of the brick with its border of neighbours.
    LOCUS_INLINE const BrickRow<Word> &row_at(unsigned py, unsigned pz) const {
        const unsigned side_y = py == 0 ? 0 : py == kPadded - 1 ? 2 : 1;
        const unsigned side_z = pz == 0 ? 0 : pz == kPadded - 1 ? 2 : 1;
        return v_.around[side_y + 3 * side_z]->row[(py + kSide - 1) % kSide + kSide * ((pz + kSide - 1) % kSide)];
    }
    LOCUS_INLINE Row share(Row operand, unsigned k) const {
        return L::share(operand, m_.factor[k], m_.low[k], m_.cap, m_.label_bits);
    }

    Visit<Word> &v_;
    const Metric<Word> &m_;
    BrickRow<Word> *own_;
    Row fill_;

private:
    LOCUS_INLINE Rule &rule() { return static_cast<Rule &>(*this); }

    LOCUS_INLINE void ascend() {
        for (RowMask ahead = v_.active; ahead != 0;) {
            const unsigned row = static_cast<unsigned>(__builtin_ctzll(ahead));
            update(row);
            ahead = v_.active & (~RowMask{1} << row);
        }
    }
    LOCUS_INLINE void descend() {
        for (RowMask ahead = v_.active; ahead != 0;) {
            const unsigned row = 63u - static_cast<unsigned>(__builtin_clzll(ahead));
            update(row);
            ahead = v_.active & ((RowMask{1} << row) - 1);
        }
    }

    LOCUS_INLINE void update(unsigned row) {
        v_.active &= ~(RowMask{1} << row);
        ++v_.updates;
        rule().prepare(row);
        v_.raise ? raise(row) : lower(row);
    }

    // Lanes 0 and 15 belong to the x-neighbours: they are not stored, but where they would improve, that neighbour is
    // woken.
    LOCUS_INLINE void lower(unsigned row) {
        const Row old = L::load(own_[row].word);
        const Row best = L::min(rule().pull(row), old);
        const uint32_t better = L::differ(best, old);
        if (better == 0)
            return;
        if ((better & ~kOwnLanes) != 0)
            wake_beside(RowMask{1} << row, better, best);
        if ((better & kOwnLanes) != 0)
            store(row, better & kOwnLanes, L::inner(best, old));
    }

    // A word smaller than all that the neighbours offer has lost its path, unless a seed lies there. Weights are at
    // least 1: voxels cannot support each other in a circle.
    LOCUS_NOINLINE void raise(unsigned row) {
        const Row old = L::load(own_[row].word);
        const Row offered = anchored(row, rule().pull(row));
        const Row none = L::all(v_.unreached);
        const uint32_t lost = L::differ(L::min(offered, old), offered) & L::differ(old, none) & kOwnLanes;
        if (lost != 0)
            store(row, lost, L::blocked(old, lost, none));
    }
    LOCUS_INLINE Row anchored(unsigned row, Row offered) const {
        alignas(64) Word word[kLanes];
        for (const Anchor<Word> &anchor : v_.anchors) {
            if (anchor.row != row)
                continue;
            L::store(offered, word);
            if (anchor.word < word[anchor.lane])
                word[anchor.lane] = anchor.word;
            offered = L::load(word);
        }
        return offered;
    }

    LOCUS_INLINE void store(unsigned row, uint32_t lanes, Row now) {
        const RowMask bit = RowMask{1} << row;
        L::store(now, own_[row].word);
        rule().stored(row, now);
        v_.changed |= bit;
        if ((lanes & 2u) != 0)
            v_.changed_first |= bit;
        if ((lanes & 0x4000u) != 0)
            v_.changed_last |= bit;
        v_.active |= dilate(bit);
    }

    LOCUS_INLINE void wake_beside(RowMask bit, uint32_t better, Row best) {
        alignas(64) Word word[kLanes];
        L::store(best, word);
        if ((better & 1u) != 0)
            wake(neighbour_number(-1, 0, 0), bit, word[0]);
        if ((better & 0x8000u) != 0)
            wake(neighbour_number(1, 0, 0), bit, word[kLanes - 1]);
    }

    LOCUS_INLINE void wake(unsigned neighbour, RowMask rows, Word key) {
        Wake<Word> &w = v_.wake[neighbour];
        w.rows |= rows;
        if (key < w.key)
            w.key = key;
    }

    // Every row around one that was raised may have lost its support.
    LOCUS_INLINE void wake_all_around() {
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const RowMask from = dx == 0 ? v_.changed : dx < 0 ? v_.changed_first : v_.changed_last;
                    const RowMask rows = touched(from, dy, dz);
                    if (rows != 0 && (dx != 0 || dy != 0 || dz != 0))
                        wake(neighbour_number(dx, dy, dz), rows, 0);
                }
    }

    // Where rows on a border in y or z changed: which rows across it would improve? Only those are woken.
    LOCUS_INLINE void reach_out() {
        const RowMask changed = v_.changed;
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy) {
                if (dy == 0 && dz == 0)
                    continue;
                const RowMask rows = touched(changed, dy, dz);
                if (rows != 0)
                    look_across(rows, dy, dz);
            }
    }

    LOCUS_INLINE void look_across(RowMask rows, int dy, int dz) {
        const Brick<Word> &there = *v_.around[static_cast<unsigned>(dy + 1 + 3 * (dz + 1))];
        const Row none = L::all(std::numeric_limits<Word>::max() >> 1);
        Row keys = none;
        RowMask first = 0, inner = 0, last = 0;
        for (; rows != 0; rows &= rows - 1) {
            const unsigned row = static_cast<unsigned>(__builtin_ctzll(rows));
            const Row old = L::load(there.row[row].word);
            const Row best = L::min(rule().offer(there.row[row], row, dy, dz), old);
            const uint32_t better = L::differ(best, old);
            if (better == 0)
                continue;
            keys = L::min(keys, L::where_differ(best, old, none));
            const RowMask bit = RowMask{1} << row;
            if ((better & kOwnLanes) != 0)
                inner |= bit;
            if ((better & 1u) != 0)
                first |= bit;
            if ((better & 0x8000u) != 0)
                last |= bit;
        }
        if ((first | inner | last) == 0)
            return;
        alignas(64) Word word[kLanes];
        L::store(keys, word);
        if (first != 0)
            wake(neighbour_number(-1, dy, dz), first, word[0]);
        if (last != 0)
            wake(neighbour_number(1, dy, dz), last, word[kLanes - 1]);
        if (inner != 0)
            for (unsigned i = 1; i <= kWidth; ++i)
                wake(neighbour_number(0, dy, dz), inner, word[i]);
    }
};

} // namespace locus::bricks::LOCUS_LANES_NAMESPACE
