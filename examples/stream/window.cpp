// Inserting, measuring, saving.
#include "stream/window.hpp"

#include <locus/storage.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace demo {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

void check(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_last_error());
}

void check_cold(locus_status status) {
    if (status != LOCUS_OK)
        throw std::runtime_error(locus_cold_last_error());
}

Window::Window(int64_t horizon, StoreLayout layout, const std::string &folder)
    : horizon_(horizon), folder_(folder), stream_clock_(horizon) {
    check(locus_pmq_options_init(&options_, sizeof options_));
    options_.record = LOCUS_RECORD_TEXT156;
    if (layout == StoreLayout::ring_leaves)
        options_.layout = LOCUS_LAYOUT_RING_LEAVES;
    if (layout != StoreLayout::ring_leaves && layout != StoreLayout::usual)
        options_.layout = LOCUS_LAYOUT_PACKED_ARRAY;
    if (layout == StoreLayout::packed_array_explicit)
        options_.index = LOCUS_INDEX_EXPLICIT;
    if (layout == StoreLayout::packed_array_heads) {
        options_.index = LOCUS_INDEX_HEADS;
        options_.segment_slots = 64;
    }
    options_.future = LOCUS_FUTURE_CLAMP;
    options_.horizon = horizon;
    if (!folder_.empty()) {
        std::filesystem::create_directories(folder_);
        for (const char *name : {"older.db", "older.db-wal", "older.db-shm"})
            std::filesystem::remove(path(name));
    }
    const locus_pmq_options options = with_tier();
    locus_pmq *store = nullptr;
    check(locus_pmq_create(&options, &store));
    store_.reset(store);
}

// Opens the tier where there is one.
locus_pmq_options Window::with_tier() {
    locus_pmq_options options = options_;
    if (folder_.empty())
        return options;
    locus_cold_options tier;
    check_cold(locus_cold_options_init(&tier, sizeof tier));
    tier.record = options.record;
    tier.when_full = LOCUS_COLD_FULL_REFUSE; // what it takes to wait is told apart from what the store takes
    queue_bytes_ = tier.queue_bytes;
    locus_cold *cold = nullptr;
    check_cold(locus_cold_open(path("older.db").c_str(), &tier, &cold));
    cold_.reset(cold);
    check_cold(locus_cold_attach(cold, &options));
    return options;
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
    const locus_status status = locus_pmq_insert(store_.get(), batch.data(), batch.size(), clock_);
    const double taken = seconds_since(begin);
    const bool full =
        status == LOCUS_E_STOPPED && cold_; // the batch is stored, what left the window waits in the store
    if (!full)
        check(status);
    seconds_.push_back(taken);
    insert_seconds_ += taken;
    if (full)
        sweep();
}

// As often as the tier is full on the way.
void Window::sweep() {
    if (clock_ == INT64_MIN)
        return;
    locus_status status = LOCUS_OK;
    while ((status = locus_pmq_sweep(store_.get(), clock_, nullptr)) == LOCUS_E_STOPPED && cold_)
        wait_for_tier();
    check(status);
}

// Until its queue is half empty.
void Window::wait_for_tier() {
    const auto begin = std::chrono::steady_clock::now();
    locus_cold_stats stats = cold_stats();
    while (stats.failure == LOCUS_OK && stats.queue_bytes > queue_bytes_ / 2) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stats = cold_stats();
    }
    if (stats.failure != LOCUS_OK)
        check_cold(locus_cold_flush(cold_.get())); // it tells why it takes no more
    const double taken = seconds_since(begin);
    ++waits_.times;
    waits_.seconds += taken;
    waits_.longest = std::max(waits_.longest, taken);
}

locus_pmq_stats Window::stats() const {
    locus_pmq_stats stats{};
    stats.struct_size = sizeof stats;
    check(locus_pmq_get_stats(store_.get(), &stats));
    return stats;
}

locus_cold_stats Window::cold_stats() const {
    locus_cold_stats stats{};
    stats.struct_size = sizeof stats;
    check_cold(locus_cold_get_stats(cold_.get(), &stats));
    return stats;
}

uint64_t Window::count_both(const locus_pmq_query *query) const {
    uint64_t count = 0;
    check_cold(locus_cold_count(cold_.get(), store_.get(), query, &count));
    return count;
}

Restart Window::restart() {
    using std::chrono::steady_clock;
    Restart result;
    const auto begin = steady_clock::now();
    check_cold(locus_cold_flush(cold_.get()));
    check(locus_pmq_save(store_.get(), nullptr, path("window.pmq").c_str(), nullptr, nullptr));
    result.saving = seconds_since(begin);
    store_.reset();
    cold_.reset();

    const auto again = steady_clock::now();
    const locus_pmq_options options = with_tier();
    locus_pmq *store = nullptr;
    check(locus_pmq_load(path("window.pmq").c_str(), &options, nullptr, nullptr, &store));
    store_.reset(store);
    sweep();
    result.loading = seconds_since(again);
    result.records = stats().records;
    result.bytes = std::filesystem::file_size(path("window.pmq"));
    return result;
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
