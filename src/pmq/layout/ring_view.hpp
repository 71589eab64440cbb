// Reading one version of the ring leaves.
#pragma once

#include "pmq/layout/layout.hpp"
#include "pmq/layout/ring_versions.hpp"

namespace locus::pmq {

// The first entry of a leaf in order of time that is not older than `time`; no entry is younger than `now`. Few are
// older, as a rule: search from the head.
size_t first_not_before(const RecordFormat &format, const LeafShape &shape, const Node &node, size_t leaf, int64_t time,
                        int64_t now) noexcept;

class RingView : public View {
public:
    RingView(const Edition &edition, const RecordFormat &format, const LeafShape &shape) noexcept
        : edition_(edition), format_(format), shape_(shape) {}

    const RecordFormat &format() const noexcept override { return format_; }
    Moment moment() const noexcept override { return edition_.moment; }
    uint64_t left() const noexcept override { return edition_.left; }
    int64_t oldest() const noexcept override;
    Place everywhere() const noexcept override;
    Place narrow(const Place &outer, const Quadrant &quadrant) const noexcept override;
    uint64_t count(const Place &place, const KeyRange &keys, int64_t from) const override;
    bool scan(const Place &place, const KeyRange &keys, int64_t from, Order order,
              FunctionRef<bool(const Block &)> visit) const override;
    uint64_t stored() const noexcept override { return edition_.stored; }

    // Call visit(node's position, leaf) for the leaves of a place until it returns false; false if it did.
    template <typename Visit>
    bool for_each_leaf(const Place &place, Visit &&visit) const {
        if (place.empty())
            return true;
        for (size_t at = position(place.first); at <= position(place.last); ++at) {
            const size_t begin = at == position(place.first) ? leaf(place.first) : 0;
            const size_t end = at == position(place.last) ? leaf(place.last) + 1 : edition_.directory[at]->leaves;
            for (size_t i = begin; i < end; ++i)
                if (!visit(at, i))
                    return false;
        }
        return true;
    }
    // All slots of a leaf, occupied or not.
    Block slots_of(const Node &node, size_t leaf) const noexcept;

private:
    // A leaf's number in a place: its node's position, then its own.
    static uint64_t number(size_t position, size_t leaf) noexcept { return position * Node::fanout + leaf; }
    static size_t position(uint64_t number) noexcept { return number / Node::fanout; }
    static size_t leaf(uint64_t number) noexcept { return number % Node::fanout; }
    uint64_t after(uint64_t at) const noexcept { // the next one's
        return leaf(at) + 1 < edition_.directory[position(at)]->leaves ? at + 1 : number(position(at) + 1, 0);
    }
    const LeafEntry &entry(uint64_t at) const noexcept { return edition_.directory[position(at)]->leaf[leaf(at)]; }
    uint64_t last_below(uint64_t key, const Place &outer) const noexcept;
    bool within(size_t position, size_t leaf, const KeyRange &keys) const noexcept;
    uint64_t count_leaf(size_t position, size_t leaf, const KeyRange &keys, int64_t from) const noexcept;
    void prefetch_times(uint64_t at, int64_t from) const noexcept;
    void prefetch_keys(uint64_t at) const noexcept;
    template <typename Visit>
    bool visit_ahead(const Place &place, int64_t from, Visit &&visit) const;
    uint64_t highest(size_t position, size_t leaf) const noexcept;
    size_t skip_older(const Node &node, size_t leaf, int64_t from, Block &block) const noexcept;
    bool scan_ring(size_t position, size_t leaf, const KeyRange &keys, int64_t from,
                   FunctionRef<bool(const Block &)> visit) const;
    bool scan_sorted(size_t position, size_t leaf, const KeyRange &keys, int64_t from,
                     FunctionRef<bool(const Block &)> visit) const;

    const Edition &edition_;
    const RecordFormat &format_;
    const LeafShape &shape_;
};

// A version that is held while the view lives.
class PinnedView final : public RingView {
public:
    PinnedView(Versions &versions, const RecordFormat &format, const LeafShape &shape)
        : PinnedView(versions, versions.pin(), format, shape) {}
    PinnedView(Versions &versions, const Versions::Hold &hold, const RecordFormat &format, const LeafShape &shape)
        : PinnedView(versions, versions.pin(hold), format, shape) {}
    ~PinnedView() override { versions_.unpin(version_); }
    PinnedView(const PinnedView &) = delete;
    PinnedView &operator=(const PinnedView &) = delete;

private:
    PinnedView(Versions &versions, const Edition &edition, const RecordFormat &format, const LeafShape &shape) noexcept
        : RingView(edition, format, shape), versions_(versions), version_(edition.version) {}

    Versions &versions_;
    uint64_t version_;
};

class RingSnapshot final : public Snapshot {
public:
    RingSnapshot(Versions &versions, const RecordFormat &format, const LeafShape &shape)
        : versions_(versions), format_(format), shape_(shape) {
        versions_.hold(hold_);
    }
    ~RingSnapshot() override { versions_.release(hold_); }
    RingSnapshot(const RingSnapshot &) = delete;
    RingSnapshot &operator=(const RingSnapshot &) = delete;
    std::shared_ptr<const View> view() const override {
        return std::make_shared<PinnedView>(versions_, hold_, format_, shape_);
    }

private:
    Versions &versions_;
    const RecordFormat &format_;
    const LeafShape &shape_;
    Versions::Hold hold_;
};

} // namespace locus::pmq
