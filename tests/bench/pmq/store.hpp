// What the PMQ cases ask of a store, so that the same code drives ours and every peer.
#ifndef LOCUS_BENCH_STORE_HPP
#define LOCUS_BENCH_STORE_HPP

#include <locus/pmq.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bench {

struct TileId {
    uint32_t zoom = 0, x = 0, y = 0;
};
constexpr std::size_t tile_bins = 256 * 256;

template <class Record>
class Store {
public:
    virtual ~Store() = default;
    /// Take a batch in order of arrival; `now` is the clock, which expires what lies before the horizon.
    virtual void insert(std::span<const Record> batch, int64_t now) = 0;
    /// Take many records at once, where only what comes after them is timed.
    virtual void load(std::span<const Record> records, int64_t now) { insert(records, now); }
    virtual uint64_t count(const locus_box &box) = 0;
    /// Copy the records of a box into `out`, which has room for all of them; their number. In whichever order is
    /// quickest,
    virtual std::size_t read(const locus_box &box, std::span<Record> out) = 0;
    /// or in that of the keys: that of peers, whose records lie in it.
    virtual std::size_t read_sorted(const locus_box &box, std::span<Record> out) { return read(box, out); }
    virtual uint64_t size() = 0;
    /// Memory held, where the store knows better than malloc; 0: it does not.
    virtual std::size_t bytes() { return 0; }
};

/// The best `out.size()` records by the space-time score with the thesis' parameters (section 3.7.6).
struct TopK {
    double latitude = 0, longitude = 0; // degrees
    int64_t now = 0;
    static constexpr std::size_t k = 100;
    static constexpr double radius_m = 30'000, alpha = 0.2, period_us = 1e10;
    double score(double latitude, double longitude, int64_t time) const; // infinite beyond radius and period
};

/// A store that can also count the 256x256 bins of a map tile, and rank.
template <class Record>
class TileStore : public Store<Record> {
public:
    virtual void tile(const TileId &tile, std::vector<uint32_t> &bins) = 0;
    /// The scores of the best, rising. As a store without rankings does it: read the box and keep the best.
    virtual std::vector<double> topk(const TopK &query);

private:
    std::vector<Record> room_;
};

enum class Layout { ours, array, array_explicit, array_heads };
/// How a dense vector regains its order: an adaptive stable sort, std::sort, or sorting the batch and merging from the
/// back.
enum class Sorting { adaptive, std_sort, merge };
enum class DenseIndex { implicit, explicit_quadtree };

template <class Record>
std::unique_ptr<TileStore<Record>> make_locus(Layout layout, int64_t horizon);
template <class Record>
std::unique_ptr<TileStore<Record>> make_btree(int64_t horizon);
template <class Record>
std::unique_ptr<Store<Record>> make_rtree(int64_t horizon);
std::unique_ptr<Store<locus_point32>> make_vector(Sorting sorting, DenseIndex index);

/// Which of the peers this build has (their headers were there).
bool have_btree();
bool have_rtree();
bool have_adaptive_sort();

inline bool inside(const locus_box &box, double latitude, double longitude) {
    return latitude >= box.south && latitude <= box.north && longitude >= box.west && longitude <= box.east;
}

template <class Record>
struct Competitor {
    std::string peer; // empty: ours
    std::function<std::unique_ptr<Store<Record>>(int64_t horizon)> make;
};

/// Ours, the thesis' array, and the trees this build has.
template <class Record>
std::vector<Competitor<Record>> competitors(bool with_rtree) {
    std::vector<Competitor<Record>> out{
        {"", [](int64_t horizon) { return make_locus<Record>(Layout::ours, horizon); }}};
    out.push_back({"array", [](int64_t horizon) { return make_locus<Record>(Layout::array, horizon); }});
    out.push_back({"array_heads", [](int64_t horizon) { return make_locus<Record>(Layout::array_heads, horizon); }});
    if (have_btree()) {
        out.push_back({"btree", [](int64_t horizon) { return make_btree<Record>(horizon); }});
    }
    if (with_rtree && have_rtree()) {
        out.push_back({"rtree", [](int64_t horizon) { return make_rtree<Record>(horizon); }});
    }
    return out;
}

} // namespace bench
#endif
