// The histogram of ages.
#include "pmq/layout/ring_ages.hpp"

#include <algorithm>

namespace locus::pmq {

void Ages::reserve(size_t times) {
    constexpr size_t many = 1024;
    if (bins_.size() > many)
        join_small();
    const size_t wanted = bins_.size() + std::min<size_t>(times, 2 * many) + 1;
    if (bins_.capacity() < wanted)
        bins_.reserve(2 * wanted);
}

void Ages::add(int64_t time) noexcept {
    ++total_;
    const bool room = bins_.size() < bins_.capacity();
    if (bins_.empty() || (time > bins_.back().last && bins_.back().count >= grain() && room)) {
        bins_.push_back({time, time, 1});
        return;
    }
    auto bin = std::upper_bound(bins_.begin(), bins_.end(), time, [](int64_t t, const Bin &b) { return t < b.first; });
    if (bin != bins_.begin())
        --bin;
    bin->first = std::min(bin->first, time);
    bin->last = std::max(bin->last, time);
    ++bin->count;
}

void Ages::take_back(int64_t time) noexcept {
    const auto bin =
        std::lower_bound(bins_.begin(), bins_.end(), time, [](const Bin &b, int64_t t) { return b.last < t; });
    if (bin == bins_.end() || time < bin->first || bin->count == 0)
        return;
    --total_;
    if (--bin->count == 0)
        bins_.erase(bin);
}

void Ages::expire(int64_t cutoff) noexcept {
    auto bin = bins_.begin();
    for (; bin != bins_.end() && bin->last < cutoff; ++bin)
        total_ -= bin->count;
    bins_.erase(bins_.begin(), bin);
}

const Ages::Bin &Ages::reach(uint64_t rank, uint64_t &before) const noexcept {
    before = 0;
    size_t i = 0;
    while (i + 1 < bins_.size() && before + bins_[i].count < rank)
        before += bins_[i++].count;
    return bins_[i];
}

void Ages::refine(const Bin &bin, std::span<const int64_t> times) {
    const auto at = bins_.begin() + (&bin - bins_.data());
    const uint64_t most = std::max<uint64_t>(times.size() / 64, 1);
    std::vector<Bin> finer; // many records of one time have a bin of their own
    for (size_t begin = 0, end = 0; begin < times.size(); begin = end) {
        while (end < times.size() && times[end] == times[begin])
            ++end;
        if (finer.empty() || finer.back().count + (end - begin) > most)
            finer.push_back({times[begin], times[begin], 0});
        finer.back().last = times[begin];
        finer.back().count += end - begin;
    }
    std::vector<Bin> all;
    all.reserve(bins_.size() + finer.size());
    all.insert(all.end(), bins_.begin(), at);
    all.insert(all.end(), finer.begin(), finer.end());
    all.insert(all.end(), at + 1, bins_.end());
    total_ = total_ - bin.count + times.size();
    bins_ = std::move(all);
}

void Ages::join_small() noexcept {
    const uint64_t most = grain();
    size_t kept = 0;
    for (size_t i = 1; i < bins_.size(); ++i) {
        if (bins_[kept].count + bins_[i].count <= most) {
            bins_[kept].last = bins_[i].last;
            bins_[kept].count += bins_[i].count;
        } else {
            bins_[++kept] = bins_[i];
        }
    }
    bins_.resize(kept + 1);
}

} // namespace locus::pmq
