// Quadrants by the best score their records may have, until none can beat the k found. That bound tightens radius and
// age as in the thesis (R W / alpha and T W / (1 - alpha) for the k-th score W), without its divisions by zero.
#include "pmq/query/ranking.hpp"

#include "pmq/query/scan.hpp"

#include <algorithm>
#include <queue>

namespace locus::pmq {
namespace {

class Search {
public:
    Search(const View &view, const Selection &selection, const Ranking &ranking, size_t k)
        : view_(view), format_(view.format()), now_(view.moment().now), live_(selection.at(view.moment())),
          filter_(selection.filter), filter_user_(selection.filter_user), ranking_(ranking), k_(k) {
        live_.region = nullptr;
        live_.filter = nullptr; // the caller is asked last, of records that are good enough
        const auto span = static_cast<uint64_t>(now_) - static_cast<uint64_t>(INT64_MIN);
        if (ranking.oldest < span)
            live_.times.from =
                std::max(live_.times.from, static_cast<int64_t>(static_cast<uint64_t>(now_) - ranking.oldest));
    }

    std::vector<Ranked> run() {
        add({}, view_.everywhere());
        while (!open_.empty() && !(full() && open_.top().bound > found_.front().score)) {
            const Candidate next = open_.top();
            open_.pop();
            if (next.place.narrow() || next.quadrant.level == key_levels)
                scan(next);
            else
                for (unsigned child = 0; child < 4; ++child)
                    add(next.quadrant.child(child), next.place);
        }
        std::sort_heap(found_.begin(), found_.end());
        return std::move(found_);
    }

private:
    struct Candidate {
        double bound;    // no record here has a better score
        double distance; // nor a smaller distance
        Quadrant quadrant;
        Place place;
        bool operator<(const Candidate &other) const noexcept { return bound > other.bound; } // the best on top
    };

    bool full() const noexcept { return found_.size() == k_; }

    void add(const Quadrant &quadrant, const Place &outer) {
        const double distance = ranking_.centre.least_distance_to(quadrant), bound = ranking_.score(distance, 0);
        if (distance > ranking_.reach || (full() && bound > found_.front().score))
            return;
        const Place place = view_.narrow(outer, quadrant);
        if (!place.empty())
            open_.push({bound, distance, quadrant, place});
    }

    // Equal keys lie in one quadrant, and a layout shows them in order of arrival.
    void scan(const Candidate &at) {
        const RangeAt range{at.place, at.quadrant.keys(), true};
        const Acceptance accepted(view_, live_, range);
        uint64_t first = 0;
        view_.scan(range.place, range.keys, live_.times.from, Order::any, [&](const Block &block) {
            for (size_t i = block.count; i-- > 0;) { // newest first
                const size_t entry = block.entry(i);
                const int64_t time = format_.time(block.record(entry));
                if (time < live_.times.from || !may_rank(ranking_.score(at.distance, age(time)))) {
                    if (block.times_ascend)
                        break; // all before are older
                    continue;
                }
                if (accepted(block, entry))
                    consider(block.key(entry), first + i, block.record(entry), time);
            }
            first += block.count;
            return true;
        });
    }

    double age(int64_t time) const noexcept {
        return static_cast<double>(static_cast<uint64_t>(now_) - static_cast<uint64_t>(time));
    }

    bool may_rank(double score) const noexcept { return !full() || score <= found_.front().score; }

    void consider(uint64_t key, uint64_t arrival, Bytes record, int64_t time) {
        const double distance = ranking_.centre.distance_to({format_.latitude(record), format_.longitude(record)});
        const Ranked ranked{ranking_.score(distance, age(time)), key, arrival, record};
        if (distance > ranking_.reach || (full() && !(ranked < found_.front())))
            return;
        if (filter_ && filter_(record, filter_user_) == 0)
            return;
        if (full()) {
            std::pop_heap(found_.begin(), found_.end());
            found_.pop_back();
        }
        found_.push_back(ranked);
        std::push_heap(found_.begin(), found_.end());
    }

    const View &view_;
    const RecordFormat &format_;
    const int64_t now_;
    Selection live_;
    locus_filter_fn filter_;
    void *filter_user_;
    const Ranking &ranking_;
    const size_t k_;
    std::priority_queue<Candidate> open_;
    std::vector<Ranked> found_; // a heap, the worst in front
};

} // namespace

std::vector<Ranked> best(const View &view, const Selection &selection, const Ranking &ranking, size_t k) {
    return Search(view, selection, ranking, k).run();
}

} // namespace locus::pmq
