// Counting by groups.
#include "explorer/groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace explorer {
namespace {

constexpr int64_t most_buckets = 2000;
constexpr uint32_t key_levels = 25;

// Every second bit of a Morton code, put together.
uint32_t half_of(uint64_t code) {
    uint32_t result = 0;
    for (uint32_t bit = 0; bit < key_levels; ++bit)
        result |= static_cast<uint32_t>(code >> 2 * bit & 1) << bit;
    return result;
}

bool fuller(const CellCount &a, const CellCount &b) {
    return a.count != b.count ? a.count > b.count : std::pair(a.y, a.x) < std::pair(b.y, b.x);
}

// Keeps the fullest cells of a sequence.
class Fullest {
public:
    explicit Fullest(size_t most) : most_(most) {}
    void add(const CellCount &cell) {
        if (heap_.size() == most_) {
            if (!fuller(cell, heap_.front()))
                return;
            std::pop_heap(heap_.begin(), heap_.end(), fuller);
            heap_.pop_back();
        }
        heap_.push_back(cell);
        std::push_heap(heap_.begin(), heap_.end(), fuller);
    }
    std::vector<CellCount> sorted() {
        std::sort_heap(heap_.begin(), heap_.end(), fuller);
        return std::move(heap_);
    }

private:
    size_t most_;
    std::vector<CellCount> heap_; // the emptiest on top
};

} // namespace

std::map<int64_t, uint64_t> count_by_time(const Tiers &tiers, const locus_pmq_query &query, int64_t step,
                                          uint64_t &total) {
    std::map<int64_t, uint64_t> buckets;
    bool many = false;
    total = 0;
    auto last = buckets.end();
    visit_records(tiers, query, [&](const locus_text156 &record) {
        const int64_t time = record.time;
        const int64_t begin = time - (time % step + step) % step;
        if (last == buckets.end() || last->first != begin)
            last = buckets.try_emplace(begin, 0).first;
        ++last->second;
        ++total;
        many = (buckets.rbegin()->first - buckets.begin()->first) / step >= most_buckets;
        return !many;
    });
    if (many)
        throw Failure(400, "step: " + std::to_string(static_cast<double>(step) / 1e6) + " s makes more than " +
                               std::to_string(most_buckets) + " buckets");
    if (!buckets.empty())
        for (int64_t begin = buckets.begin()->first; begin < buckets.rbegin()->first; begin += step)
            buckets.try_emplace(begin, 0);
    return buckets;
}

// The store's order is that of the cells, so each cell's records come one after the other.
std::vector<CellCount> count_by_cell(const Tiers &tiers, const locus_pmq_query &query, uint32_t zoom, size_t count,
                                     uint64_t &total) {
    Fullest fullest(count);
    const uint32_t shift = 2 * (key_levels - zoom);
    uint64_t code = 0, run = 0;
    const auto end_run = [&] {
        if (run > 0)
            fullest.add({half_of(code), half_of(code >> 1), run});
        run = 0;
    };
    total = 0;
    visit_records(tiers, query, [&](const locus_text156 &record) {
        uint64_t key = 0;
        check(locus_pmq_key(record.latitude, record.longitude, &key));
        if (key >> shift != code)
            end_run();
        code = key >> shift;
        ++run;
        ++total;
        return true;
    });
    end_run();
    return fullest.sorted();
}

locus_box tile_box(uint32_t zoom, uint32_t x, uint32_t y) {
    const double tiles = std::exp2(zoom);
    const auto latitude = [&](double row) {
        return std::atan(std::sinh(std::numbers::pi * (1 - 2 * row / tiles))) * 180 / std::numbers::pi;
    };
    return {latitude(y + 1.0), x / tiles * 360 - 180, latitude(y), (x + 1.0) / tiles * 360 - 180};
}

} // namespace explorer
