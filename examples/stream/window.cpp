// Inserting and measuring.
#include "stream/window.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <stdexcept>

namespace demo {

void check(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_last_error());
}

Window::Window(int64_t horizon, StoreLayout layout) : horizon_(horizon), stream_clock_(horizon) {
    locus_pmq_options options;
    check(locus_pmq_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    if (layout == StoreLayout::ring_leaves)
        options.layout = LOCUS_LAYOUT_RING_LEAVES;
    if (layout == StoreLayout::packed_array || layout == StoreLayout::packed_array_explicit)
        options.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    if (layout == StoreLayout::packed_array_explicit)
        options.index = LOCUS_INDEX_EXPLICIT;
    options.future = LOCUS_FUTURE_CLAMP;
    options.horizon = horizon;
    locus_pmq *store = nullptr;
    check(locus_pmq_create(&options, &store));
    store_.reset(store);
}

void Window::insert(const std::vector<locus_text156> &batch) {
    if (batch.empty())
        return;
    clock_ = stream_clock_.advance(batch);
    for (const locus_text156 &record : batch) {
        if (record.time > clock_)
            ++ahead_;
        // The subtraction on the clock's side cannot overflow for clocks of this era, but times are anybody's.
        else if (clock_ >= INT64_MIN + horizon_ && record.time < clock_ - horizon_)
            ++late_;
    }
    const auto begin = std::chrono::steady_clock::now();
    check(locus_pmq_insert(store_.get(), batch.data(), batch.size(), clock_));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    seconds_.push_back(taken.count());
    insert_seconds_ += taken.count();
}

void Window::sweep() {
    if (clock_ != INT64_MIN)
        check(locus_pmq_sweep(store_.get(), clock_, nullptr));
}

locus_pmq_stats Window::stats() const {
    locus_pmq_stats stats{};
    stats.struct_size = sizeof stats;
    check(locus_pmq_get_stats(store_.get(), &stats));
    return stats;
}

Latencies Window::latencies() const {
    if (seconds_.empty())
        return {};
    std::vector<double> sorted = seconds_;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double part) {
        return sorted[std::min(sorted.size() - 1, static_cast<size_t>(part * static_cast<double>(sorted.size())))];
    };
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    return {sum / static_cast<double>(sorted.size()), at(0.5), at(0.99), sorted.back()};
}

} // namespace demo
