// The default layout: a directory in the order of the Z-curve over small leaves, each a ring of slots in order of
// arrival. A relative of the thesis' packed-memory array that gives up the order within a leaf: inserting appends, and
// what expires is a prefix of a ring, so that no call has to move much.
#pragma once

#include "pmq/departures.hpp"
#include "pmq/layout/layout.hpp"
#include "pmq/layout/ring_ages.hpp"
#include "pmq/layout/ring_slabs.hpp"
#include "pmq/layout/ring_times.hpp"
#include "pmq/layout/ring_versions.hpp"

#include <bitset>
#include <vector>

namespace locus::pmq {

class RingLeaves final : public Layout {
public:
    RingLeaves(const RecordFormat &format, const Limits &limits);
    ~RingLeaves() override;
    RingLeaves(const RingLeaves &) = delete;
    RingLeaves &operator=(const RingLeaves &) = delete;

    void insert(const Batch &batch, Eviction &eviction, Departures &departures) override;
    void sweep(Eviction &eviction, Departures &departures) override;
    void erase(const Selection &selection, Departures &departures) override;
    void fill(const Batch &batch, Crew &crew, Eviction &eviction, Departures &departures) override;
    size_t fill_batch() const noexcept override;
    bool fills_in_parts() const noexcept override { return !ages_.wanted(); }
    std::unique_ptr<Parts> fill_parts(std::span<const size_t> sizes, Eviction &eviction) override;
    std::shared_ptr<const View> view() const override;
    bool views_last() const noexcept override { return true; }
    std::shared_ptr<const Snapshot> snapshot() const override;
    LayoutStats stats() const override;
    void check() const override;

private:
    // From construction to destruction the directory may be changed; then the new version is published.
    class Change {
    public:
        Change(RingLeaves &store, bool is_short);
        ~Change();
        Change(const Change &) = delete;
        Change &operator=(const Change &) = delete;

    private:
        RingLeaves &store_;
    };
    // Which entries of a leaf leave: a prefix of the ring, and the marked ones behind it.
    struct Cut {
        Cut(size_t node_at, size_t leaf_at) : node(node_at), leaf(leaf_at) {}
        void everything() noexcept { // all are marked
            prefix = marked;
            marked = 0;
        }
        bool takes(size_t entry) const noexcept { return entry < prefix || (marked > 0 && marks[entry]); }
        size_t node, leaf;
        size_t prefix = 0, marked = 0;
        LeafMemory fresh = nullptr; // where the rest goes
        std::bitset<LeafShape::most_slots> marks;
    };
    // A leaf that is being written: entries from `head` on.
    struct Target {
        LeafMemory memory;
        size_t head;
        uint8_t unit; // of the times at hand
        size_t count = 0;
        uint8_t known = 0;
        int64_t oldest = INT64_MAX, newest = INT64_MIN;
        bool ordered = true;
    };
    struct Spot {
        size_t node, leaf;
    };
    class Filling;
    // What readers of the versions born..retired - 1 may still see.
    struct Garbage {
        uint64_t born, retired;
        LeafMemory leaf;
        Node *node;
        Edition *edition;
    };

    // ring_leaves.cpp: versions and their memory
    void begin(bool is_short);
    void finish() noexcept;
    void collect_garbage() noexcept;
    void expect_garbage(size_t things);
    void free_garbage(const Garbage &thing) noexcept;
    uint64_t garbage_bytes() const noexcept;
    bool unread(uint64_t born) const noexcept { return born >= read_.until; } // until the end of the change
    void discard(const Garbage &thing) noexcept;
    void retire(LeafMemory leaf, uint64_t born) noexcept;
    void retire(Node *node) noexcept;
    Node *take_node();
    void spare(Node *node) noexcept;
    Node &own(size_t position);
    Edition &edition() noexcept { return *edition_; }
    void check_leaf(const Node &node, size_t position, size_t leaf, uint64_t next) const;
    Directory &directory() noexcept { return edition_->directory; }
    const Directory &directory() const noexcept { return edition_->directory; }
    uint64_t bytes() const noexcept;

    // ring_insert.cpp
    void append(const Batch &batch);
    void append_group(const Batch &batch, size_t begin, size_t end, size_t &done);
    void put(Node &node, size_t leaf, uint64_t key, Bytes record) noexcept;
    void take_back(const Batch &batch, size_t done) noexcept;
    Spot find(uint64_t key) const noexcept;
    void make_room(const Spot &spot, uint64_t key);
    void split_node(size_t position);
    uint64_t pivot(const Node &node, size_t leaf) const noexcept;
    void partition(size_t position, size_t leaf, uint64_t pivot);
    void relocate(size_t position, size_t leaf);
    Target target(LeafMemory memory, size_t head = 0) const noexcept {
        return {memory, head, slabs_.keep_times() ? HeadTimes::unit_for(edition_->moment) : HeadTimes::no_unit};
    }
    void add(Target &target, uint64_t key, Bytes record) const noexcept;
    void install(Node &node, size_t leaf, const Target &target) noexcept;

    // ring_fill.cpp
    int64_t fill_leaf(const Batch &batch, Target &target) const noexcept;
    void append_leaf(uint64_t key, const Target &filled);

    // ring_expiry.cpp
    void collect(size_t position, int64_t cutoff, Eviction *eviction, bool thoroughly, std::vector<Cut> &cuts) const;
    void mark_expired(const Node &node, size_t leaf, int64_t cutoff, bool thoroughly, Cut &cut) const;
    void ask(const Node &node, size_t leaf, int64_t cutoff, Eviction &eviction, Cut &cut) const;
    std::vector<Cut> decide(size_t first, size_t nodes, int64_t cutoff, Eviction &eviction, bool thoroughly) const;
    void remove(std::vector<Cut> &cuts, Departures &departures);
    void apply(const Cut &cut) noexcept;
    void pop(Node &node, size_t leaf, size_t entries) noexcept;
    double elapsed() noexcept;
    void tend(size_t records, Eviction &eviction, Departures &departures);
    void note_times(size_t position);
    void note_times(Node &node, size_t leaf, int64_t until) const noexcept;
    void tend_nodes(size_t first, size_t nodes, Eviction &eviction, Departures &departures);
    void sweep_all(const Moment &moment, Eviction &eviction, Departures &departures);

    // ring_limits.cpp
    Moment clock(const Batch &batch, const Moment &moment, uint64_t &ties);
    void admit_late(const Batch &batch, Eviction &eviction, Departures &departures);
    int64_t limit_cutoff(uint64_t most, int64_t cutoff, uint64_t &ties);
    void refine(const Ages::Bin &bin, int64_t cutoff);
    void drop_equal(int64_t time, uint64_t count, Departures &departures);
    void hold_bytes(Departures &departures);

    // ring_tidy.cpp
    void tidy(size_t position) noexcept;
    void tidy_all() noexcept;
    void drop_leaf(Node &node, size_t leaf) noexcept;
    void merge_leaves(size_t position, size_t leaf);
    void merge_in_time(Target &target, const Node &node, size_t left, size_t right) const noexcept;
    void merge_nodes(size_t position);

    uint64_t key_at(const Node &node, size_t leaf, size_t entry) const noexcept {
        return shape_.keys(node.leaf[leaf].memory)[shape_.slot(node.leaf[leaf].head, entry)];
    }
    Bytes record_at(const Node &node, size_t leaf, size_t entry) const noexcept {
        return shape_.record(node.leaf[leaf].memory, shape_.slot(node.leaf[leaf].head, entry));
    }
    int64_t time_at(const Node &node, size_t leaf, size_t entry) const noexcept {
        return format_.time(record_at(node, leaf, entry));
    }

    const RecordFormat &format_;
    const LeafShape shape_;
    const Limits limits_;
    Slabs slabs_;
    mutable Versions versions_;
    Edition *edition_ = nullptr; // the current one, or during a change the one to come
    uint64_t change_ = 0;        // the version being made
    Versions::Read read_{};
    std::vector<Garbage> garbage_;
    size_t garbage_leaves_ = 0, garbage_next_ = 0,
           discarded_ = 0; // the leaves in it; the next to be looked at; new ones
    std::vector<uint64_t> readers_;
    Node *spare_nodes_ = nullptr;
    size_t nodes_ = 0, spares_ = 0;
    uint64_t structure_ = 0; // counts changes of the directory: positions found before are void
    int64_t newest_ = INT64_MIN;
    Ages ages_;
    int64_t floor_ = INT64_MIN;  // the cutoff of the limits; older records may be left in slots
    uint64_t most_records_;      // the limit on live records at present
    size_t cursor_ = 0;          // the node the incremental sweep comes to next,
    int64_t tended_ = INT64_MIN; // when it last went on
    double credit_ = 0;          // and how many leaves it may look at
    size_t leaf_count_ = 0;
    LayoutStats counters_;
};

} // namespace locus::pmq
