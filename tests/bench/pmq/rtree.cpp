// Peer: boost::geometry's R-tree with quadratic splits of 16, on the records' coordinates in degrees.
#include "tests/bench/pmq/store.hpp"

#if __has_include(<boost/geometry/index/rtree.hpp>)
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstring>
#include <deque>
#include <iterator>

namespace bench {
namespace {

namespace bg = boost::geometry;
using Place = bg::model::point<double, 2, bg::cs::cartesian>;

template <class Record>
struct PlaceOf {
    using result_type = Place;
    Place operator()(const Record &record) const { return {record.longitude, record.latitude}; }
};
template <class Record>
struct Same {
    bool operator()(const Record &a, const Record &b) const { return std::memcmp(&a, &b, sizeof a) == 0; }
};

template <class Record>
class RTree final : public Store<Record> {
public:
    explicit RTree(int64_t horizon) : horizon_(horizon) {}

    void insert(std::span<const Record> batch, int64_t now) override {
        for (const Record &record : batch) {
            tree_.insert(record);
            if (horizon_ != LOCUS_NO_HORIZON) {
                arrivals_.push_back(record);
            }
        }
        while (!arrivals_.empty() && arrivals_.front().time < now - horizon_) {
            tree_.remove(arrivals_.front());
            arrivals_.pop_front();
        }
    }

    uint64_t count(const locus_box &box) override { return tree_.query(bg::index::intersects(area(box)), Counter{}); }

    std::size_t read(const locus_box &box, std::span<Record> out) override {
        return tree_.query(bg::index::intersects(area(box)), out.begin());
    }

    uint64_t size() override { return tree_.size(); }

private:
    struct Counter { // an output iterator that drops what it is given
        using iterator_category = std::output_iterator_tag;
        using value_type = void;
        using difference_type = std::ptrdiff_t;
        using pointer = void;
        using reference = void;
        Counter &operator*() { return *this; }
        Counter &operator++() { return *this; }
        Counter operator++(int) { return *this; }
        Counter &operator=(const Record &) { return *this; }
    };

    static bg::model::box<Place> area(const locus_box &box) {
        return {Place{box.west, box.south}, Place{box.east, box.north}};
    }

    bg::index::rtree<Record, bg::index::quadratic<16>, PlaceOf<Record>, Same<Record>> tree_;
    std::deque<Record> arrivals_;
    int64_t horizon_;
};

} // namespace

bool have_rtree() { return true; }
template <class Record>
std::unique_ptr<Store<Record>> make_rtree(int64_t horizon) {
    return std::make_unique<RTree<Record>>(horizon);
}

} // namespace bench
#else
namespace bench {
bool have_rtree() { return false; }
template <class Record>
std::unique_ptr<Store<Record>> make_rtree(int64_t) {
    return nullptr;
}
} // namespace bench
#endif

namespace bench {
template std::unique_ptr<Store<locus_point32>> make_rtree(int64_t);
template std::unique_ptr<Store<locus_text156>> make_rtree(int64_t);
} // namespace bench
