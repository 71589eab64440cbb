// Top-k without a ranking store.
#include "tests/bench/data/records.hpp"
#include "tests/bench/pmq/store.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bench {

double TopK::score(double other_latitude, double other_longitude, int64_t time) const {
    constexpr double radian = std::numbers::pi / 180;
    const double height = std::sin((other_latitude - latitude) * radian / 2);
    const double width = std::sin((other_longitude - longitude) * radian / 2);
    const double square =
        height * height + std::cos(latitude * radian) * std::cos(other_latitude * radian) * width * width;
    const double distance = 2 * LOCUS_EARTH_RADIUS * std::asin(std::min(1.0, std::sqrt(square)));
    const auto age = static_cast<double>(now - time);
    if (distance > radius_m || age > period_us) {
        return std::numeric_limits<double>::infinity();
    }
    return alpha * (distance / radius_m) + (1 - alpha) * (age / period_us);
}

template <class Record>
std::vector<double> TileStore<Record>::topk(const TopK &query) {
    const locus_box box = box_around(query.latitude, query.longitude, 1.01e-3 * TopK::radius_m);
    room_.resize(this->count(box));
    const std::size_t found = this->read(box, room_);
    std::vector<double> best; // a heap, the worst in front
    for (std::size_t i = 0; i < found; ++i) {
        const double score = query.score(room_[i].latitude, room_[i].longitude, room_[i].time);
        if (std::isinf(score) || (best.size() == TopK::k && score >= best.front())) {
            continue;
        }
        if (best.size() == TopK::k) {
            std::pop_heap(best.begin(), best.end());
            best.pop_back();
        }
        best.push_back(score);
        std::push_heap(best.begin(), best.end());
    }
    std::sort_heap(best.begin(), best.end());
    return best;
}
template std::vector<double> TileStore<locus_point32>::topk(const TopK &);
template std::vector<double> TileStore<locus_text156>::topk(const TopK &);

} // namespace bench
