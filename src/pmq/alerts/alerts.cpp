// From a batch to the callbacks. Nothing here allocates, so that a batch that is stored cannot fail.
#include "pmq/alerts/alerts.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::pmq {
namespace {

constexpr int64_t minute = 60'000'000;

const locus_alerts_options &checked(const locus_alerts_options &options) {
    check_alerts_options(options);
    return options;
}

} // namespace

locus_alerts_options default_alerts_options() noexcept {
    locus_alerts_options options{};
    options.struct_size = sizeof options;
    options.zoom_from = 5;
    options.zoom_to = 12;
    options.half_life = 5 * minute;
    options.history = 60 * minute;
    options.cool_down = 30 * minute;
    options.minimum = 20;
    options.factor = 4;
    options.rate = options.share = std::numeric_limits<double>::infinity();
    options.max_bytes = uint64_t{64} << 20;
    return options;
}

void check_alerts_options(const locus_alerts_options &o) {
    require(o.zoom_to <= key_levels, "options.zoom_to is ", o.zoom_to, ", above ", key_levels);
    require(o.zoom_from <= o.zoom_to, "options.zoom_from is ", o.zoom_from, ", above zoom_to, ", o.zoom_to);
    require(o.half_life > 0, "options.half_life is ", o.half_life, ", not positive");
    require(o.history / 2 >= o.half_life && o.history / 100 <= o.half_life, "options.history is ", o.history,
            ", not 2..100 times half_life, ", o.half_life);
    require(o.cool_down >= 0, "options.cool_down is ", o.cool_down, ", negative");
    require(o.minimum > 0 && std::isfinite(o.minimum), "options.minimum is ", o.minimum, ", not above 0 and finite");
    require(o.factor > 1, "options.factor is ", o.factor, ", not above 1");
    require(o.rate > 0, "options.rate is ", o.rate, ", not above 0");
    require(o.share > 0 && (o.share <= 1 || std::isinf(o.share)), "options.share is ", o.share,
            ", not above 0 and up to 1, nor INFINITY");
    require(o.max_bytes >= 65536, "options.max_bytes is ", o.max_bytes, ", below 65536");
}

Alerts::Alerts(const locus_alerts_options &options)
    : options_(checked(options)), activity_(options.zoom_to, options.half_life, options.history, options.max_bytes),
      watch_(options) {
    activity_bytes_ = activity_.bytes();
}

bool Alerts::arrived(const Batch &batch, const RecordFormat &format, const Moment &moment) {
    count(batch, format, moment);
    return (options_.fence == nullptr || !any_fences() || show(batch, format, moment)) && tell();
}

bool Alerts::any_fences() const {
    const std::lock_guard lock(fences_mutex_);
    return !fences_.empty();
}

void Alerts::count(const Batch &batch, const RecordFormat &format, const Moment &moment) noexcept {
    activity_.begin(moment.now);
    for (size_t i = 0; i < batch.count; ++i)
        if (const int64_t time = format.time(batch.records + i * format.size); time >= moment.cutoff)
            activity_.add(batch.keys[i], time);
    watch_.look(activity_, moment.now);
    activity_.tend(batch.count);
    regions_ = activity_.size();
    activity_bytes_ = activity_.bytes();
}

// The fences of a chunk's records are found under the lock, and told of without it.
bool Alerts::show(const Batch &batch, const RecordFormat &format, const Moment &moment) {
    for (size_t begin = 0, end = 0; begin < batch.count; begin = end) {
        end = gather(batch, begin, format, moment);
        for (size_t i = begin, next = 0; i < end; ++i)
            for (; next < ends_[i - begin]; ++next)
                if (!show_to_fence(*found_[next], batch.records + i * format.size))
                    return false;
    }
    found_.clear();
    return true;
}

size_t Alerts::gather(const Batch &batch, size_t begin, const RecordFormat &format, const Moment &moment) {
    found_.clear();
    const std::lock_guard lock(fences_mutex_);
    if (found_.capacity() < fences_.size() + chunk_found)
        found_.swap(room_);
    size_t at = begin;
    for (; at < batch.count && at < begin + chunk_records && found_.size() < chunk_found; ++at) {
        const Bytes record = batch.records + at * format.size;
        if (format.time(record) >= moment.cutoff)
            fences_.find(batch.keys[at], record, format, found_);
        ends_[at - begin] = found_.size();
    }
    return at;
}

bool Alerts::show_to_fence(const Fence &fence, Bytes record) {
    const Selection &selection = fence.selection;
    if (ended_ || fence.removed || (selection.filter && selection.filter(record, selection.filter_user) == 0))
        return true;
    ++shown_;
    return options_.fence(fence.id, record, options_.fence_user) == 0;
}

bool Alerts::tell() {
    if (options_.alert == nullptr)
        return true;
    for (const locus_alert &alert : watch_.raised())
        if (!ended_ && options_.alert(&alert, options_.alert_user) != 0)
            return false;
    return true;
}

void Alerts::add_fence(uint64_t id, std::unique_ptr<const Region> region, const Selection &selection) {
    const std::lock_guard lock(fences_mutex_);
    const size_t wanted = fences_.size() + 1 + chunk_found;
    if (room_.capacity() < wanted)
        room_.reserve(2 * wanted);
    fences_.add(id, std::move(region), selection);
}

void Alerts::remove_fence(uint64_t id) {
    const std::lock_guard lock(fences_mutex_);
    fences_.remove(id);
}

locus_alerts_stats Alerts::stats() const {
    locus_alerts_stats stats{};
    stats.struct_size = sizeof stats;
    stats.regions = regions_;
    stats.raised = watch_.raised_ever();
    stats.shown = shown_;
    const std::lock_guard lock(fences_mutex_);
    stats.fences = fences_.size();
    stats.bytes = sizeof *this + activity_bytes_ + watch_.bytes() + fences_.bytes() +
                  2 * room_.capacity() * sizeof(Fences::Found::value_type);
    return stats;
}

} // namespace locus::pmq
