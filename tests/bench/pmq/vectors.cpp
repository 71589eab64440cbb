// Peers: a dense vector of (key, record) kept sorted, searched by key or through a pointer quadtree (thesis
// section 3.7.2).
#include "tests/bench/pmq/cover.hpp"
#include "tests/bench/pmq/store.hpp"

#include <array>

#if __has_include(<boost/sort/sort.hpp>)
#include <boost/sort/spinsort/spinsort.hpp>
#define LOCUS_BENCH_SPINSORT 1
#endif

namespace bench {
namespace {

struct Element {
    uint64_t key;
    locus_point32 record;
};
bool before(const Element &a, const Element &b) { return a.key < b.key; }

/// A stable sort that finds what is sorted already, as TimSort does.
void adaptive_sort(std::vector<Element> &elements) {
#ifdef LOCUS_BENCH_SPINSORT
    boost::sort::spinsort(elements.begin(), elements.end(), before);
#else
    std::stable_sort(elements.begin(), elements.end(), before);
#endif
}

/// A pointer quadtree over a sorted vector: a node is split while it holds more than a segment of 8 records.
class Quadtree {
public:
    struct Node {
        std::size_t first, end;
        std::array<uint32_t, 4> children{}; // 0: none
    };

    void rebuild(const std::vector<Element> &elements) {
        nodes_.clear();
        nodes_.push_back({0, elements.size()});
        split(elements, 0, 0, 0);
    }
    /// The elements of the key range, found from the root down.
    std::pair<std::size_t, std::size_t> find(const std::vector<Element> &elements, const CoverRange &range) const {
        return {lower(elements, range.keys.lo), lower(elements, range.keys.hi)};
    }

private:
    static constexpr std::size_t leaf = 8;

    void split(const std::vector<Element> &elements, uint32_t node, uint64_t prefix, unsigned level) {
        const auto [first, end] = std::pair(nodes_[node].first, nodes_[node].end);
        if (end - first <= leaf || level == key_levels) {
            return;
        }
        const unsigned shift = 2 * (key_levels - level - 1);
        std::size_t start = first;
        for (unsigned child = 0; child < 4; ++child) {
            const uint64_t bound = prefix + (uint64_t{child + 1} << shift);
            const auto stop = std::lower_bound(elements.begin() + static_cast<std::ptrdiff_t>(start),
                                               elements.begin() + static_cast<std::ptrdiff_t>(end), bound,
                                               [](const Element &e, uint64_t key) { return e.key < key; });
            const auto next = static_cast<std::size_t>(stop - elements.begin());
            if (next > start) {
                const auto id = static_cast<uint32_t>(nodes_.size());
                nodes_.push_back({start, next});
                nodes_[node].children[child] = id;
                split(elements, id, prefix + (uint64_t{child} << shift), level + 1);
            }
            start = next;
        }
    }

    std::size_t lower(const std::vector<Element> &elements, uint64_t key) const {
        if (key >= locus::key_end) {
            return elements.size();
        }
        uint32_t node = 0;
        for (unsigned level = 0;; ++level) {
            const Node &at = nodes_[node];
            const unsigned shift = 2 * (key_levels - level - 1);
            if (at.end - at.first <= leaf || level == key_levels) {
                std::size_t i = at.first;
                for (; i < at.end && elements[i].key < key; ++i) {
                }
                return i;
            }
            const unsigned child = key >> shift & 3;
            if (at.children[child] == 0) { // an empty quadrant: what follows it
                for (unsigned next = child + 1; next < 4; ++next) {
                    if (at.children[next] != 0) {
                        return nodes_[at.children[next]].first;
                    }
                }
                return at.end;
            }
            node = at.children[child];
        }
    }

    std::vector<Node> nodes_;
};

class DenseVector final : public Store<locus_point32> {
public:
    DenseVector(Sorting sorting, DenseIndex index) : sorting_(sorting), index_(index) {}

    void insert(std::span<const locus_point32> batch, int64_t) override {
        const std::ptrdiff_t sorted = append(batch);
        const auto tail = elements_.begin() + sorted;
        switch (sorting_) {
        case Sorting::adaptive:
            adaptive_sort(elements_);
            break;
        case Sorting::merge:
            std::stable_sort(tail, elements_.end(), before);
            merge_from_back(sorted);
            break;
        case Sorting::std_sort:
            std::sort(elements_.begin(), elements_.end(), before);
            break;
        }
        if (index_ == DenseIndex::explicit_quadtree) {
            quadtree_.rebuild(elements_);
        }
    }

    void load(std::span<const locus_point32> records, int64_t) override {
        const std::ptrdiff_t sorted = append(records);
        std::stable_sort(elements_.begin() + sorted, elements_.end(), before);
        std::inplace_merge(elements_.begin(), elements_.begin() + sorted, elements_.end(), before);
        if (index_ == DenseIndex::explicit_quadtree) {
            quadtree_.rebuild(elements_);
        }
    }

    uint64_t count(const locus_box &box) override {
        uint64_t found = 0;
        each(box, [&](const locus_point32 &) { ++found; });
        return found;
    }

    std::size_t read(const locus_box &box, std::span<locus_point32> out) override {
        std::size_t found = 0;
        each(box, [&](const locus_point32 &record) { out[found++] = record; });
        return found;
    }

    uint64_t size() override { return elements_.size(); }

private:
    /// Put the records behind the sorted part, whose length is returned.
    std::ptrdiff_t append(std::span<const locus_point32> records) {
        const std::size_t sorted = elements_.size();
        for (const locus_point32 &record : records) {
            elements_.push_back({key_of(record.latitude, record.longitude), record});
        }
        return static_cast<std::ptrdiff_t>(sorted);
    }

    /// Merge the sorted tail into the sorted front: blocks of the front move up in one piece, the largest keys first.
    void merge_from_back(std::ptrdiff_t sorted) {
        const std::vector<Element> tail(elements_.begin() + sorted, elements_.end());
        auto front = elements_.begin() + sorted;
        auto to = elements_.end();
        for (auto next = tail.rbegin(); next != tail.rend(); ++next) {
            const auto stays = std::upper_bound(elements_.begin(), front, *next, before);
            to = std::move_backward(stays, front, to);
            *--to = *next;
            front = stays;
        }
    }

    template <class Visit>
    void each(const locus_box &box, Visit visit) {
        const auto lower = [&](uint64_t key) {
            return static_cast<std::size_t>(std::lower_bound(elements_.begin(), elements_.end(), key,
                                                             [](const Element &e, uint64_t k) { return e.key < k; }) -
                                            elements_.begin());
        };
        for (const CoverRange &range : cover(box)) {
            const auto [first, end] = index_ == DenseIndex::explicit_quadtree
                                          ? quadtree_.find(elements_, range)
                                          : std::pair(lower(range.keys.lo), lower(range.keys.hi));
            for (std::size_t i = first; i < end; ++i) {
                const locus_point32 &record = elements_[i].record;
                if (range.whole || inside(box, record.latitude, record.longitude)) {
                    visit(record);
                }
            }
        }
    }

    std::vector<Element> elements_;
    Quadtree quadtree_;
    Sorting sorting_;
    DenseIndex index_;
};

} // namespace

#ifdef LOCUS_BENCH_SPINSORT
bool have_adaptive_sort() { return true; }
#else
bool have_adaptive_sort() { return false; }
#endif

std::unique_ptr<Store<locus_point32>> make_vector(Sorting sorting, DenseIndex index) {
    return std::make_unique<DenseVector>(sorting, index);
}

} // namespace bench
