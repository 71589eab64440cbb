// Separable weights q_k(u) + q_k(v): the neighbour's share is added once per row and shared by all who look. A row's
// helper rows are D + q_k, and for offsets that move along x and another axis their minimum over x - 1 and x + 1.
// Included by the same rules as pull-inl.hpp, after it.

namespace locus::bricks::LOCUS_LANES_NAMESPACE {

// Which helper row serves which offsets. With cubic voxels the classes coincide and four rows do.
template <bool Isotropic>
struct Helper;
template <>
struct Helper<true> {
    enum : unsigned { x = 0, y = 0, z = 0, yz = 1, xy = 2, xz = 2, xyz = 3, count = 4 };
};
template <>
struct Helper<false> {
    enum : unsigned { x = 0, y = 1, z = 2, yz = 3, xy = 4, xz = 5, xyz = 6, count = 7 };
};

template <typename Word, bool Isotropic>
class MeanVisit : public PullVisit<Word, MeanVisit<Word, Isotropic>> {
    using Base = PullVisit<Word, MeanVisit<Word, Isotropic>>;
    using L = Lanes<Word>;
    using Row = typename L::Row;
    using H = Helper<Isotropic>;
    static constexpr unsigned Y = 1, Z = kPadded; // strides between padded rows

public:
    // A visit with much to do builds all helper rows in one sweep, one with little those it needs.
    LOCUS_INLINE explicit MeanVisit(Visit<Word> &visit) : Base(visit) {
        if (__builtin_popcountll(visit.active) < 8)
            return;
        for (unsigned pz = 0; pz < kPadded; ++pz) {
            ready_[pz] = (1u << kPadded) - 1;
            for (unsigned py = 0; py < kPadded; ++py)
                build(py, pz);
        }
    }

    // The helper rows of the 3 x 3 rows around `row`.
    LOCUS_INLINE void prepare(unsigned row) {
        const unsigned y = row % kSide, z = row / kSide;
        if (((ready_[z] & ready_[z + 1] & ready_[z + 2]) >> y & 7u) == 7u)
            return;
        for (unsigned pz = z; pz < z + 3; ++pz)
            for (unsigned py = y; py < y + 3; ++py)
                need(py + kPadded * pz);
    }

    LOCUS_INLINE Row pull(unsigned row) const {
        const unsigned s = padded(row);
        const Row x = beside(helper(s, H::x));
        const Row y = L::min(helper(s - Y, H::y), helper(s + Y, H::y));
        const Row z = L::min(helper(s - Z, H::z), helper(s + Z, H::z));
        const Row xy = L::min(helper(s - Y, H::xy), helper(s + Y, H::xy));
        const Row xz = L::min(helper(s - Z, H::xz), helper(s + Z, H::xz));
        const Row yz = L::min(L::min(helper(s - Z - Y, H::yz), helper(s - Z + Y, H::yz)),
                              L::min(helper(s + Z - Y, H::yz), helper(s + Z + Y, H::yz)));
        const Row xyz = L::min(L::min(helper(s - Z - Y, H::xyz), helper(s - Z + Y, H::xyz)),
                               L::min(helper(s + Z - Y, H::xyz), helper(s + Z + Y, H::xyz)));
        const Shares q = shares(this->own_[row].operand);
        if constexpr (Isotropic) {
            return min3(L::add(q.k[1], min3(x, y, z)), L::add(q.k[3], min3(xy, xz, yz)), L::add(q.k[7], xyz));
        } else {
            const Row face = min3(L::add(q.k[1], x), L::add(q.k[2], y), L::add(q.k[4], z));
            const Row edge = min3(L::add(q.k[3], xy), L::add(q.k[5], xz), L::add(q.k[6], yz));
            return min3(face, edge, L::add(q.k[7], xyz));
        }
    }

    LOCUS_INLINE void stored(unsigned row, Row now) { rebuild(padded(row), now, shares(this->own_[row].operand)); }

    // What the rows of this brick that face row `row` of the brick across (dy, dz) offer to it.
    LOCUS_INLINE Row offer(const BrickRow<Word> &to, unsigned row, int dy, int dz) {
        const int across = dy + static_cast<int>(kPadded) * dz;
        const auto s = static_cast<unsigned>(static_cast<int>(padded(row)) + static_cast<int>(kSide) * across - across);
        const Shares q = shares(to.operand);
        const bool diagonal = dy != 0 && dz != 0;
        const unsigned along = dy != 0 ? Z : Y;
        need(s);
        if (diagonal)
            return L::min(L::add(q.k[Isotropic ? 3 : 6], helper(s, H::yz)), L::add(q.k[7], helper(s, H::xyz)));
        need(s - along);
        need(s + along);
        const Row face = L::add(q.k[Isotropic ? 1 : dy != 0 ? 2 : 4], helper(s, dy != 0 ? H::y : H::z));
        const Row edge = L::add(q.k[Isotropic ? 3 : dy != 0 ? 3 : 5], helper(s, dy != 0 ? H::xy : H::xz));
        const Row slant = L::add(q.k[Isotropic ? 3 : 6], L::min(helper(s - along, H::yz), helper(s + along, H::yz)));
        const Row corner = L::add(q.k[7], L::min(helper(s - along, H::xyz), helper(s + along, H::xyz)));
        return L::min(min3(face, edge, slant), corner);
    }

private:
    struct Shares {
        Row k[8];
    };

    LOCUS_INLINE static Row min3(Row a, Row b, Row c) { return L::min(L::min(a, b), c); }
    LOCUS_INLINE Row helper(unsigned s, unsigned kind) const { return L::load(helper_[s][kind]); }
    LOCUS_INLINE Row beside(Row a) const { return L::min(L::left(a, this->fill_), L::right(a, this->fill_)); }

    LOCUS_INLINE Shares shares(const float *operand) const {
        const Row c = L::operand(operand);
        Shares q;
        q.k[1] = this->share(c, 1);
        q.k[3] = this->share(c, 3);
        q.k[7] = this->share(c, 7);
        if constexpr (!Isotropic) {
            q.k[2] = this->share(c, 2);
            q.k[4] = this->share(c, 4);
            q.k[5] = this->share(c, 5);
            q.k[6] = this->share(c, 6);
        }
        return q;
    }

    LOCUS_INLINE void need(unsigned s) {
        const unsigned py = s % kPadded, pz = s / kPadded;
        if ((ready_[pz] >> py & 1u) == 0)
            build_late(py, pz);
    }
    LOCUS_NOINLINE void build_late(unsigned py, unsigned pz) {
        ready_[pz] = static_cast<uint16_t>(ready_[pz] | 1u << py);
        build(py, pz);
    }
    LOCUS_INLINE void build(unsigned py, unsigned pz) {
        const BrickRow<Word> &row = this->row_at(py, pz);
        rebuild(py + kPadded * pz, L::load(row.word), shares(row.operand));
    }

    LOCUS_INLINE void rebuild(unsigned s, Row d, const Shares &q) {
        Word(*h)[kLanes] = helper_[s];
        if constexpr (Isotropic) {
            const Row edge = L::add(d, q.k[3]);
            L::store(L::add(d, q.k[1]), h[H::x]);
            L::store(edge, h[H::yz]);
            L::store(beside(edge), h[H::xy]);
        } else {
            L::store(L::add(d, q.k[1]), h[H::x]);
            L::store(L::add(d, q.k[2]), h[H::y]);
            L::store(L::add(d, q.k[4]), h[H::z]);
            L::store(L::add(d, q.k[6]), h[H::yz]);
            L::store(beside(L::add(d, q.k[3])), h[H::xy]);
            L::store(beside(L::add(d, q.k[5])), h[H::xz]);
        }
        L::store(beside(L::add(d, q.k[7])), h[H::xyz]);
    }

    uint16_t ready_[kPadded] = {}; // by pz, bit py
    alignas(64) Word helper_[kPadded * kPadded][H::count][kLanes];
};

template <typename Word, bool Isotropic>
void visit_mean(Visit<Word> &visit) {
    MeanVisit<Word, Isotropic>(visit).run();
}

template <typename Word>
inline constexpr MeanKernels<Word> mean_table = {visit_mean<Word, true>, visit_mean<Word, false>};

} // namespace locus::bricks::LOCUS_LANES_NAMESPACE
