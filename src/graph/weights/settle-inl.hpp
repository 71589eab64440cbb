// The kernels of settle.hpp over the row operations `Lanes` of one instruction set. Compiled once per set, in its own
// namespace; hence no include guard and no includes.

namespace locus::graph::LOCUS_LANES_NAMESPACE {

template <typename Word>
class Sweeper {
    using L = locus::bricks::LOCUS_LANES_NAMESPACE::Lanes<Word>;

public:
    LOCUS_INLINE explicit Sweeper(Settle<Word> &settle) : s_(settle) {}

    LOCUS_INLINE void run() {
        changed_rows_ = s_.fresh_rows; // the starts are news to the first sweep and to the second
        for (bool forward = true; !s_.fresh_rows.empty() && pulls_ < s_.most_pulls; forward = !forward) {
            forward ? sweep<true>() : sweep<false>();
            keep_changes();
            changed_rows_ = Hull{};
        }
    }

    // `ground(v)`: the row that voxel v goes back to.
    template <typename Ground>
    LOCUS_INLINE void restore(Ground ground) {
        for_touched_rows([&](size_t row) {
            Span &span = s_.touched_spans[row];
            for (size_t x = span.first; !span.empty() && x <= span.last; ++x) {
                const size_t v = row * s_.sizes[0] + x;
                L::store(ground(v), s_.reach + v * batch_lanes);
                s_.stolen[v] = 0;
            }
            span = Span{};
        });
        s_.touched = Hull{};
    }

    LOCUS_INLINE void mark_stolen() {
        for_touched_rows([&](size_t row) {
            const Span &span = s_.touched_spans[row];
            for (size_t x = span.first; !span.empty() && x <= span.last; ++x) {
                const size_t v = row * s_.sizes[0] + x;
                s_.stolen[v] =
                    static_cast<uint16_t>(L::differ(L::load(s_.reach + v * batch_lanes), L::all(s_.nearest[v])));
            }
        });
    }

private:
    template <typename Visit>
    LOCUS_INLINE void for_touched_rows(Visit visit) {
        if (s_.touched.empty())
            return;
        for (size_t z = s_.touched.z.first; z <= s_.touched.z.last; ++z)
            for (size_t y = s_.touched.y.first; y <= s_.touched.y.last; ++y)
                visit(z * s_.sizes[1] + y);
    }

    // One sweep in raster order, or against it. A row is visited where a row that it pulls from has changed in this
    // sweep or the one before.
    template <bool Forward>
    LOCUS_INLINE void sweep() {
        const ptrdiff_t one = Forward ? 1 : -1;
        const size_t z_border = Forward ? s_.sizes[2] - 2 : 1, y_border = Forward ? s_.sizes[1] - 2 : 1;
        const Hull &fresh = s_.fresh_rows;
        const size_t z_end = inner(Forward ? fresh.z.last + 1 : fresh.z.first - 1, 2);
        size_t z = Forward ? fresh.z.first : fresh.z.last;
        for (;; z = z + static_cast<size_t>(one)) {
            Span rows = fresh.y;
            rows.add(changed_rows_.y);
            const size_t low = inner(rows.first - 1, 1), high = inner(rows.last + 1, 1);
            bool plane_changed = false;
            for (size_t y = Forward ? low : high;; y = y + static_cast<size_t>(one)) {
                const bool row_changed = visit_row<Forward>(y, z);
                plane_changed |= row_changed;
                const bool beyond = Forward ? y >= high : y <= low;
                if (y == y_border || (beyond && !row_changed))
                    break;
            }
            const bool beyond = Forward ? z >= z_end : z <= z_end;
            if (z == z_border || (beyond && !plane_changed))
                break;
        }
    }

    LOCUS_INLINE size_t inner(size_t place, unsigned axis) const {
        return place < 1 ? 1 : (place > s_.sizes[axis] - 2 ? s_.sizes[axis] - 2 : place);
    }

    template <bool Forward>
    LOCUS_INLINE bool visit_row(size_t y, size_t z) {
        const size_t wy = s_.sizes[1], row = z * wy + y;
        const ptrdiff_t side = Forward ? -1 : 1;
        Span span = s_.fresh[row];
        const size_t plane = row + static_cast<size_t>(side * static_cast<ptrdiff_t>(wy));
        for (const size_t other : {plane - 1, plane, plane + 1, row + static_cast<size_t>(side)}) {
            span.add(s_.fresh[other]);
            span.add(s_.changed[other]);
        }
        ++pulls_;
        if (span.empty())
            return false;
        const size_t first = inner(span.first - 1, 0), last = inner(span.last + 1, 0);
        pulls_ += last - first;
        Span &changed = s_.changed[row];
        if constexpr (Forward) {
            size_t end = last;
            for (size_t x = first; x <= end; ++x) {
                if (!pull<true>(row * s_.sizes[0] + x))
                    continue;
                changed.add(static_cast<uint32_t>(x));
                if (x == end)
                    end = inner(end + 1, 0);
            }
        } else {
            size_t end = first;
            for (size_t x = last; x >= end; --x) {
                if (!pull<false>(row * s_.sizes[0] + x))
                    continue;
                changed.add(static_cast<uint32_t>(x));
                if (x == end)
                    end = inner(end - 1, 0);
            }
        }
        if (changed.empty())
            return false;
        changed_rows_.add(y, z);
        return true;
    }

    // The smallest of a voxel's own words and those over its 13 edges backward (or forward); true if any fell.
    template <bool Forward>
    LOCUS_INLINE bool pull(size_t v) {
        const auto old = L::load(s_.reach + v * batch_lanes);
        auto least = old;
        for (unsigned n = 0; n < backward_edges; ++n) {
            const size_t from = Forward ? v + static_cast<size_t>(s_.step[n]) : v - static_cast<size_t>(s_.step[n]);
            const Word weight = s_.back[(Forward ? v : from) * backward_edges + n];
            least = L::min(least, L::add(L::load(s_.reach + from * batch_lanes), L::all(weight)));
        }
        if (L::differ(least, old) == 0)
            return false;
        L::store(least, s_.reach + v * batch_lanes);
        return true;
    }

    // What this sweep changed is what the next one starts from.
    LOCUS_INLINE void keep_changes() {
        const Hull stale = s_.fresh_rows;
        if (!stale.empty())
            for (size_t z = stale.z.first; z <= stale.z.last; ++z)
                for (size_t y = stale.y.first; y <= stale.y.last; ++y)
                    s_.fresh[z * s_.sizes[1] + y] = Span{};
        if (!changed_rows_.empty())
            for (size_t z = changed_rows_.z.first; z <= changed_rows_.z.last; ++z)
                for (size_t y = changed_rows_.y.first; y <= changed_rows_.y.last; ++y)
                    s_.touched_spans[z * s_.sizes[1] + y].add(s_.changed[z * s_.sizes[1] + y]);
        Span *const emptied = s_.fresh;
        s_.fresh = s_.changed;
        s_.changed = emptied;
        s_.fresh_rows = changed_rows_;
        s_.touched.add(changed_rows_);
    }

    Settle<Word> &s_;
    Hull changed_rows_;
    uint64_t pulls_ = 0;
};

template <typename Word>
void settle(Settle<Word> &settle) {
    Sweeper<Word>(settle).run();
}
template <typename Word>
void mark(Settle<Word> &settle) {
    Sweeper<Word>(settle).mark_stolen();
}
template <typename Word>
void restore_nearest(Settle<Word> &settle) {
    using L = locus::bricks::LOCUS_LANES_NAMESPACE::Lanes<Word>;
    Sweeper<Word>(settle).restore([&](size_t v) { return L::all(settle.nearest[v]); });
}
template <typename Word>
void restore_bound(Settle<Word> &settle) {
    using L = locus::bricks::LOCUS_LANES_NAMESPACE::Lanes<Word>;
    const auto bound = L::load(settle.bound);
    Sweeper<Word>(settle).restore([&](size_t) { return bound; });
}

template <typename Word>
constexpr SettleKernels<Word> settle_kernels_of = {settle<Word>, mark<Word>, restore_nearest<Word>,
                                                   restore_bound<Word>};
constexpr SettleTable settle_table = {settle_kernels_of<uint32_t>, settle_kernels_of<uint64_t>};

} // namespace locus::graph::LOCUS_LANES_NAMESPACE
