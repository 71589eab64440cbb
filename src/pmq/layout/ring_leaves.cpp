// The versions of the directory and the memory they share.
#include "pmq/layout/ring_leaves.hpp"

#include "pmq/layout/ring_view.hpp"

#include <algorithm>
#include <memory>
#include <new>

namespace locus::pmq {

RingLeaves::RingLeaves(const RecordFormat &format, const Limits &limits)
    : format_(format), shape_(format), limits_(limits), slabs_(shape_.bytes(), limits.bytes),
      ages_(limits.records != UINT64_MAX || limits.bytes != UINT64_MAX), most_records_(limits.records) {
    auto first = std::make_unique<Edition>();
    first->directory.reserve_one();
    std::unique_ptr<Node> node(new Node);
    node->clear();
    node->insert(0, 0, slabs_.take());
    first->directory.insert(0, node.release());
    nodes_ = leaf_count_ = 1;
    edition_ = first.release();
    versions_.publish(*edition_);
}

RingLeaves::~RingLeaves() {
    Edition *last = versions_.current();
    for (size_t i = 0; i < last->directory.size(); ++i)
        delete last->directory[i];
    delete last;
    for (const Garbage &thing : garbage_) {
        delete thing.node;
        delete thing.edition;
    }
    while (spare_nodes_)
        delete std::exchange(spare_nodes_, spare_nodes_->next);
}

RingLeaves::Change::Change(RingLeaves &store, bool is_short) : store_(store) { store_.begin(is_short); }
RingLeaves::Change::~Change() { store_.finish(); }

void RingLeaves::begin(bool is_short) {
    read_ = versions_.begin(is_short);
    edition_ = versions_.current();
    change_ = edition_->version + 1;
    if (unread(edition_->version))
        return;
    try {
        expect_garbage(1);
        edition_ = new Edition(*edition_);
    } catch (...) {
        versions_.publish(*edition_);
        throw;
    }
}

void RingLeaves::finish() noexcept {
    Edition *before = versions_.current();
    const uint64_t born = before->version;
    edition_->version = change_;
    versions_.publish(*edition_);
    if (before != edition_)
        discard({born, change_, nullptr, nullptr, before});
    collect_garbage();
    while (garbage_bytes() > limits_.snapshot_bytes && versions_.withdraw_oldest())
        for (size_t left = garbage_.size() + 1; left > garbage_.size() && !garbage_.empty();) {
            left = garbage_.size();
            collect_garbage();
        }
}

// Free what no reader can see. A few more things are looked at than have come, so that none waits long.
void RingLeaves::collect_garbage() noexcept {
    if (garbage_.empty())
        return;
    try {
        versions_.readers(readers_);
    } catch (const std::bad_alloc &) {
        return; // later
    }
    constexpr size_t steady = 1024;
    for (size_t budget = discarded_ + steady; budget > 0 && !garbage_.empty(); --budget) {
        if (garbage_next_ == 0)
            garbage_next_ = garbage_.size();
        Garbage &thing = garbage_[--garbage_next_];
        const auto reader = std::lower_bound(readers_.begin(), readers_.end(), thing.born);
        if (reader != readers_.end() && *reader < thing.retired)
            continue;
        free_garbage(thing);
        thing = garbage_.back();
        garbage_.pop_back();
        garbage_next_ = std::min(garbage_next_, garbage_.size());
    }
    discarded_ = 0;
}

void RingLeaves::free_garbage(const Garbage &thing) noexcept {
    if (thing.leaf) {
        slabs_.give_back(thing.leaf);
        --garbage_leaves_;
    }
    if (thing.node)
        spare(thing.node);
    delete thing.edition;
}

uint64_t RingLeaves::garbage_bytes() const noexcept {
    return garbage_leaves_ * shape_.bytes() + (garbage_.size() - garbage_leaves_) * sizeof(Node);
}

// Make sure that so many things can be discarded without failing, and the old edition.
void RingLeaves::expect_garbage(size_t things) {
    const size_t wanted = garbage_.size() + things + 1;
    if (garbage_.capacity() < wanted)
        garbage_.reserve(2 * wanted);
}

void RingLeaves::discard(const Garbage &thing) noexcept {
    garbage_.push_back(thing); // expected
    garbage_leaves_ += thing.leaf != nullptr;
    ++discarded_;
}

void RingLeaves::retire(LeafMemory leaf, uint64_t born) noexcept {
    if (unread(born))
        slabs_.give_back(leaf);
    else
        discard({born, change_, leaf, nullptr, nullptr});
}

void RingLeaves::retire(Node *node) noexcept {
    if (unread(node->version))
        spare(node);
    else
        discard({node->version, change_, nullptr, node, nullptr});
}

Node *RingLeaves::take_node() {
    if (!spare_nodes_) {
        Node *node = new Node;
        ++nodes_;
        return node;
    }
    --spares_;
    return std::exchange(spare_nodes_, spare_nodes_->next);
}

void RingLeaves::spare(Node *node) noexcept {
    if (spares_ > nodes_ / 2 + 64) {
        delete node;
        --nodes_;
        return;
    }
    node->next = spare_nodes_;
    spare_nodes_ = node;
    ++spares_;
}

// The node at a position, safe to be changed. When nobody can see its former entries any more, their slots are free.
Node &RingLeaves::own(size_t position) {
    Node *node = directory()[position];
    if (node->version == change_)
        return *node;
    if (!unread(node->version)) {
        expect_garbage(1);
        Node *copy = take_node();
        *copy = *node;
        retire(node);
        directory().replace(position, copy);
        node = copy;
    }
    node->version = change_;
    if (node->ghost_version != 0 && (unread(0) || node->ghost_version <= read_.oldest)) {
        for (LeafEntry &leaf : node->leaf)
            leaf.ghosts = 0;
        node->ghost_version = 0;
    }
    return *node;
}

std::shared_ptr<const View> RingLeaves::view() const {
    return std::make_shared<PinnedView>(versions_, format_, shape_);
}

std::shared_ptr<const Snapshot> RingLeaves::snapshot() const {
    return std::make_shared<RingSnapshot>(versions_, format_, shape_);
}

LayoutStats RingLeaves::stats() const {
    LayoutStats stats = counters_;
    stats.stored = versions_.current()->stored;
    stats.slots = leaf_count_ * shape_.slots;
    stats.bytes = bytes();
    stats.grows = slabs_.mapped();
    stats.shrinks = slabs_.unmapped();
    return stats;
}

uint64_t RingLeaves::bytes() const noexcept {
    return slabs_.bytes() + nodes_ * sizeof(Node) + versions_.current()->directory.bytes() +
           garbage_.capacity() * sizeof(Garbage) + ages_.bytes() + sizeof *this;
}

} // namespace locus::pmq
