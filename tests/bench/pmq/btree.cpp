// Peer: absl::btree_multimap on the key. Expiry finds the oldest record's key in a queue of keys in order of arrival.
#include "tests/bench/pmq/cover.hpp"
#include "tests/bench/pmq/store.hpp"

#if __has_include(<absl/container/btree_map.h>)
#include <absl/container/btree_map.h>

#include <deque>

namespace bench {
namespace {

template <class Record>
class BTree final : public TileStore<Record> {
public:
    explicit BTree(int64_t horizon) : horizon_(horizon) {}

    void insert(std::span<const Record> batch, int64_t now) override {
        for (const Record &record : batch) {
            const uint64_t key = key_of(record.latitude, record.longitude);
            map_.emplace(key, record);
            if (horizon_ != LOCUS_NO_HORIZON) {
                arrivals_.push_back({key, record.time});
            }
        }
        while (!arrivals_.empty() && arrivals_.front().time < now - horizon_) {
            map_.erase(map_.lower_bound(arrivals_.front().key)); // the oldest of equal keys comes first
            arrivals_.pop_front();
        }
    }

    uint64_t count(const locus_box &box) override {
        uint64_t found = 0;
        each(box, [&](const Record &) { ++found; });
        return found;
    }

    std::size_t read(const locus_box &box, std::span<Record> out) override {
        std::size_t found = 0;
        each(box, [&](const Record &record) { out[found++] = record; });
        return found;
    }

    void tile(const TileId &tile, std::vector<uint32_t> &bins) override {
        bins.assign(tile_bins, 0);
        const locus::KeyRange keys = locus::Quadrant::of_tile(tile.zoom, tile.x, tile.y).keys();
        const unsigned shift = 2 * (key_levels - tile.zoom - 8); // the cases ask for zooms up to 17
        const auto end = map_.lower_bound(keys.hi);
        for (auto at = map_.lower_bound(keys.lo); at != end; ++at) {
            const uint64_t bin = (at->first - keys.lo) >> shift;
            ++bins[locus::morton_y(bin) << 8 | locus::morton_x(bin)];
        }
    }

    uint64_t size() override { return map_.size(); }

private:
    struct Arrival {
        uint64_t key;
        int64_t time;
    };

    template <class Visit>
    void each(const locus_box &box, Visit visit) {
        for (const CoverRange &range : cover(box)) {
            for (auto at = map_.lower_bound(range.keys.lo); at != map_.end() && at->first < range.keys.hi; ++at) {
                if (range.whole || inside(box, at->second.latitude, at->second.longitude)) {
                    visit(at->second);
                }
            }
        }
    }

    absl::btree_multimap<uint64_t, Record> map_;
    std::deque<Arrival> arrivals_;
    int64_t horizon_;
};

} // namespace

bool have_btree() { return true; }
template <class Record>
std::unique_ptr<TileStore<Record>> make_btree(int64_t horizon) {
    return std::make_unique<BTree<Record>>(horizon);
}

} // namespace bench
#else
namespace bench {
bool have_btree() { return false; }
template <class Record>
std::unique_ptr<TileStore<Record>> make_btree(int64_t) {
    return nullptr;
}
} // namespace bench
#endif

namespace bench {
template std::unique_ptr<TileStore<locus_point32>> make_btree(int64_t);
template std::unique_ptr<TileStore<locus_text156>> make_btree(int64_t);
} // namespace bench
