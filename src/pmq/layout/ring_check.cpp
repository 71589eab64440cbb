// Verifying every invariant of the ring leaves.
#include "core/error.hpp"
#include "pmq/layout/ring_leaves.hpp"

#include <unordered_set>

namespace locus::pmq {
namespace {

template <typename... Parts>
void expect(bool good, const Parts &...parts) {
    if (!good)
        fail(LOCUS_E_INTERNAL, "ring leaves: ", parts...);
}

} // namespace

void RingLeaves::check() const {
    const Edition &now = *versions_.current();
    uint64_t stored = 0, before = 0;
    size_t leaves = 0;
    std::unordered_set<const std::byte *> memory;
    for (size_t n = 0; n < now.directory.size(); ++n) {
        const Node &node = *now.directory[n];
        expect(node.leaves >= 1 && node.leaves <= Node::fanout, "node ", n, " has ", node.leaves, " leaves");
        expect(now.directory.smallest(n) == node.separators[0], "node ", n, " is listed at ", now.directory.smallest(n),
               " and begins at ", node.separators[0]);
        expect(now.directory.find(node.separators[0]) >= n && now.directory.find_below(node.separators[0]) <= n,
               "node ", n, " is not found at its key ", node.separators[0]);
        uint64_t total = 0;
        for (size_t i = 0; i < node.leaves; ++i) {
            const uint64_t next = i + 1 < node.leaves            ? node.separators[i + 1]
                                  : n + 1 < now.directory.size() ? now.directory.smallest(n + 1)
                                                                 : key_end - 1;
            expect(node.separators[i] >= before, "the separators of node ", n, " run back at leaf ", i);
            before = node.separators[i];
            check_leaf(node, n, i, next);
            expect(memory.insert(node.leaf[i].memory).second, "leaf ", i, " of node ", n, " is there twice");
            total += node.leaf[i].count;
        }
        for (size_t i = node.leaves; i < Node::fanout; ++i)
            expect(node.separators[i] == Node::unused, "node ", n, " has a separator beyond its leaves");
        expect(total == node.total, "node ", n, " counts ", node.total, " entries and holds ", total);
        stored += total;
        leaves += node.leaves;
    }
    expect(now.directory.smallest(0) == 0, "the first node begins at ", now.directory.smallest(0));
    expect(stored == now.stored, "the directory counts ", now.stored, " entries and holds ", stored);
    expect(leaves == leaf_count_, "there are ", leaves, " leaves, not ", leaf_count_);
    size_t retired = 0;
    for (const Garbage &thing : garbage_)
        retired += thing.leaf != nullptr;
    expect(slabs_.leaves() == leaves + retired, "slabs hold ", slabs_.leaves(), " leaves, the directory ", leaves,
           ", readers ", retired);
}

void RingLeaves::check_leaf(const Node &node, size_t position, size_t leaf, uint64_t next) const {
    const size_t count = node.leaf[leaf].count;
    const auto name = [&] { return " in leaf " + std::to_string(leaf) + " of node " + std::to_string(position); };
    expect(node.leaf[leaf].head < shape_.slots && count + node.leaf[leaf].ghosts <= shape_.slots, "head ",
           node.leaf[leaf].head, ", count ", count, ", ghosts ", node.leaf[leaf].ghosts, name());
    const HeadTimes times(shape_, node.leaf[leaf]);
    expect(node.leaf[leaf].known <= std::min(count, LeafShape::most_times), node.leaf[leaf].known,
           " times are at hand, of ", count, " entries", name());
    for (size_t i = 0; i < node.leaf[leaf].known; ++i)
        expect(times.says(i, time_at(node, leaf, i)), "the time at hand of entry ", i, " is another's", name());
    for (size_t i = 0; i < count; ++i) {
        const uint64_t key = key_at(node, leaf, i);
        const Bytes record = record_at(node, leaf, i);
        expect(key == key_of(format_.latitude(record), format_.longitude(record)), "entry ", i,
               " has the key of another place", name());
        expect(key >= node.separators[leaf] && key <= next, "key ", key, " lies outside ", node.separators[leaf], "..",
               next, name());
        expect(format_.time(record) >= node.leaf[leaf].oldest, "entry ", i, " is older than it says", name());
        expect(!node.is_ordered(leaf) || i == 0 || time_at(node, leaf, i - 1) <= format_.time(record), "entry ", i,
               " is out of the order of time", name());
    }
}

} // namespace locus::pmq
