// Filling a new store.
#include "pmq/restoring.hpp"

#include "core/zcurve.hpp"

#include <algorithm>

namespace locus::pmq {

Restoring::Restoring(Store &store, int64_t now, Crew &crew)
    : store_(store), crew_(crew), format_(store.format_),
      eviction_(store.format_, Moment::at(now, store.options_.horizon), nullptr, nullptr),
      enough_(store.layout_->fill_batch()) {}

// Few records are kept until there are enough of them.
void Restoring::add(const Batch &batch) {
    if (keys_.empty() && batch.count >= enough_) {
        fill(batch);
        return;
    }
    keys_.insert(keys_.end(), batch.keys, batch.keys + batch.count);
    records_.insert(records_.end(), batch.records, batch.records + batch.count * format_.size);
    oldest_ = std::min(oldest_, batch.oldest);
    if (keys_.size() >= enough_)
        flush();
}

bool Restoring::takes_parts() const noexcept { return store_.layout_->fills_in_parts(); }

std::unique_ptr<Layout::Parts> Restoring::begin_parts(std::span<const size_t> sizes) {
    return store_.layout_->fill_parts(sizes, eviction_);
}

void Restoring::end_parts(Layout::Parts &parts) { store_.inserted_ += parts.install(); }

void Restoring::flush() {
    if (keys_.empty())
        return;
    fill({records_.data(), keys_.data(), keys_.size(), oldest_});
    keys_.clear();
    records_.clear();
    oldest_ = INT64_MAX;
}

void Restoring::fill(const Batch &batch) {
    store_.layout_->fill(batch, crew_, eviction_, store_.departures_);
    store_.inserted_ += batch.count;
    enough_ = store_.layout_->fill_batch();
}

void Restoring::insert(std::span<const std::byte> records) {
    flush();
    const size_t count = records.size() / format_.size;
    int64_t oldest = INT64_MAX;
    keys_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const Bytes record = records.data() + i * format_.size;
        keys_[i] = key_of(format_.latitude(record), format_.longitude(record));
        oldest = std::min(oldest, format_.time(record));
    }
    store_.layout_->insert({records.data(), keys_.data(), count, oldest}, eviction_, store_.departures_);
    store_.inserted_ += count;
    keys_.clear();
}

void Restoring::depart(Bytes record) {
    constexpr size_t together = 8192;
    if (!leaving_)
        leaving_.emplace(store_.departures_);
    leaving_->add(record);
    ++store_.inserted_;
    if (leaving_->count() == together)
        flush_departures();
}

void Restoring::flush_departures() {
    if (leaving_)
        leaving_->commit();
    leaving_.reset();
}

void Restoring::finish() {
    flush();
    flush_departures();
    store_.layout_->sweep(eviction_, store_.departures_);
    store_.layout_->insert({nullptr, nullptr, 0, INT64_MAX}, eviction_, store_.departures_); // the limit of memory
    store_.evicted_ = store_.departures_.left();
    store_.left_apart_ = store_.departures_.left() - store_.layout_->view()->left();
    store_.now_ = moment().now;
    store_.publish_figures();
}

} // namespace locus::pmq
