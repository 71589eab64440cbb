// The store's side of every call that changes it.
#include "pmq/store.hpp"

#include "core/error.hpp"
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/query/ranges.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <unordered_set>
#include <utility>

namespace locus::pmq {
namespace {

const locus_pmq_options &checked_options(const locus_pmq_options &options) {
    check_options(options);
    return options;
}

} // namespace

Store::Store(const locus_pmq_options &options)
    : options_(checked_options(options)), format_(record_format(options)), layout_(make_layout(options)),
      departures_(format_, options.sink, options.sink_user) {
    publish_figures();
}

Store::~Store() {
    if (journal_)
        journal_->close();
}

std::shared_ptr<const View> Store::view() const {
    if (layout_->views_last())
        return layout_->view();
    const auto reading = std::make_shared<std::shared_lock<std::shared_mutex>>(gate_, std::defer_lock);
    {
        const std::lock_guard turn(turnstile_);
        reading->lock();
    }
    const std::shared_ptr<const View> view = layout_->view();
    return {reading, view.get()};
}

Eviction Store::eviction_at(int64_t now) const {
    require(now >= now_, "now is ", now, ", before the clock's ", now_);
    return Eviction(format_, Moment::at(now, options_.horizon), options_.remove, options_.remove_user);
}

void Store::check_record(Bytes record, size_t index, int64_t now) const {
    const double latitude = format_.latitude(record), longitude = format_.longitude(record);
    require(latitude >= -90 && latitude <= 90, "records[", index, "].latitude is ", latitude, ", not within -90..90");
    require(longitude >= -180 && longitude <= 180, "records[", index, "].longitude is ", longitude,
            ", not within -180..180");
    require(format_.time(record) <= now || options_.future == LOCUS_FUTURE_CLAMP, "records[", index, "].time is ",
            format_.time(record), ", after now, ", now);
}

// Check the records, bring their times down to `now` where the options say so, and find their keys.
Batch Store::checked(Bytes records, size_t count, int64_t now) {
    keys_.resize(count);
    int64_t oldest = INT64_MAX, youngest = INT64_MIN;
    constexpr size_t chunk = 128;
    double latitudes[chunk], longitudes[chunk];
    for (size_t begin = 0; begin < count; begin += chunk) {
        const size_t size = std::min(chunk, count - begin);
        for (size_t i = 0; i < size; ++i) {
            const Bytes record = records + (begin + i) * format_.size;
            check_record(record, begin + i, now);
            latitudes[i] = format_.latitude(record);
            longitudes[i] = format_.longitude(record);
            oldest = std::min(oldest, format_.time(record));
            youngest = std::max(youngest, format_.time(record));
        }
        find_keys_(latitudes, longitudes, keys_.data() + begin, size);
    }
    if (youngest > now) {
        clamped_.assign(records, records + count * format_.size);
        for (size_t i = 0; i < count; ++i) {
            std::byte *record = clamped_.data() + i * format_.size;
            format_.set_time(record, std::min(format_.time(record), now));
        }
        records = clamped_.data();
    }
    return {records, keys_.data(), count, std::min(oldest, now)};
}

// Let the layout change, then hand over what has left. How many records left.
template <typename Change>
uint64_t Store::change(Change &&change) {
    const auto start = std::chrono::steady_clock::now();
    const LayoutStats before = options_.log ? layout_->stats() : LayoutStats{};
    const uint64_t left = departures_.left();
    {
        std::unique_lock alone(gate_, std::defer_lock);
        if (!layout_->views_last()) {
            const std::lock_guard turn(turnstile_);
            alone.lock();
        }
        change();
    }
    const auto pause = std::chrono::steady_clock::now() - start;
    longest_pause_ns_ = std::max(
        longest_pause_ns_, static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(pause).count()));
    log_growth(before);
    return departures_.left() - left;
}

// A change that is written to the log first, if there is one. What leaves by horizon the log knows from the cutoff; if
// more may leave, it is told afterwards.
template <typename Change>
uint64_t Store::logged(EntryKind kind, const Moment &moment, std::span<const std::byte> records, Change &&work) {
    if (!journal_)
        return change(work);
    const bool open = options_.remove || options_.max_records != LOCUS_NO_LIMIT || options_.max_bytes != LOCUS_NO_LIMIT;
    result_due_ = kind != EntryKind::erase && open;
    journal_->begin(kind, result_due_, moment, records);
    if (result_due_)
        departures_.note(moment.cutoff);
    try {
        return change(work);
    } catch (...) {
        departures_.note_no_more();
        journal_->undo();
        throw;
    }
}

void Store::log_result() {
    if (!journal_ || !std::exchange(result_due_, false))
        return;
    try {
        const Moment moment = layout_->view()->moment();
        journal_->result(moment, departures_.noted(moment.cutoff));
    } catch (const std::bad_alloc &) { // no call that has changed the store is out of memory
        departures_.note_no_more();
        publish_figures();
        journal_->fall_behind("out of memory");
        throw Error(LOCUS_E_IO, "log has stopped"); // short enough to need none
    } catch (...) {
        departures_.note_no_more();
        publish_figures();
        throw;
    }
}

bool Store::insert(Bytes records, size_t count, int64_t now) {
    const Writing writing(*this);
    Eviction eviction = eviction_at(now);
    const Batch batch = checked(records, count, now);
    evicted_ += logged(EntryKind::insert, eviction.moment(), {batch.records, count * format_.size},
                       [&] { layout_->insert(batch, eviction, departures_); });
    now_ = now;
    inserted_ += count;
    ++batches_;
    log_result();
    const bool handed_over = hand_over();
    const bool told = tell(batch, eviction.moment());
    return handed_over && told && !eviction.stopped();
}

void Store::observe(std::shared_ptr<Observer> observer) {
    const Writing writing(*this);
    std::erase_if(observers_, [](const auto &one) { return one->ended(); });
    observers_.push_back(std::move(observer));
}

// Every observer is told, also after one whose callback stopped. None comes while this goes on.
bool Store::tell(const Batch &batch, const Moment &moment) {
    bool completely = true;
    std::erase_if(observers_, [](const auto &one) { return one->ended(); });
    for (const std::shared_ptr<Observer> &observer : observers_)
        completely = observer->arrived(batch, format_, moment) && completely;
    return completely;
}

bool Store::sweep(int64_t now, uint64_t &evicted) {
    const Writing writing(*this);
    Eviction eviction = eviction_at(now);
    evicted = logged(EntryKind::sweep, eviction.moment(), {}, [&] { layout_->sweep(eviction, departures_); });
    now_ = now;
    evicted_ += evicted;
    log_result();
    const bool handed_over = hand_over();
    return handed_over && !eviction.stopped();
}

bool Store::erase(const Selection &selection, uint64_t &erased) {
    const Writing writing(*this);
    erased = journal_ ? erase_logged(selection) : change([&] { layout_->erase(selection, departures_); });
    erased_ += erased;
    return hand_over();
}

namespace {

// Accepts the records at known addresses.
int32_t is_among(const void *record, void *addresses) {
    return static_cast<const std::unordered_set<const void *> *>(addresses)->contains(record);
}

} // namespace

// What is to be erased is found first, and logged; the filter is asked then.
uint64_t Store::erase_logged(const Selection &selection) {
    std::shared_ptr<const View> now = layout_->view();
    const Moment moment = now->moment();
    std::vector<std::byte> records;
    std::unordered_set<const void *> addresses;
    for_each_record(*now, selection, Order::any, [&](uint64_t, Bytes record) {
        records.insert(records.end(), record, record + format_.size);
        if (selection.filter)
            addresses.insert(record);
        return true;
    });
    now.reset(); // nobody reads, as far as this call knows
    Selection found = selection;
    if (selection.filter) {
        found.filter = is_among;
        found.filter_user = &addresses;
    }
    return logged(EntryKind::erase, moment, records, [&] { layout_->erase(found, departures_); });
}

void Store::log_growth(const LayoutStats &before) const {
    const LayoutStats after = layout_->stats();
    if (!options_.log || (after.grows == before.grows && after.shrinks == before.shrinks))
        return;
    char text[160];
    std::snprintf(text, sizeof text, "%s from %llu to %llu slots for %llu records",
                  after.slots > before.slots ? "grown" : "shrunk", static_cast<unsigned long long>(before.slots),
                  static_cast<unsigned long long>(after.slots), static_cast<unsigned long long>(after.stored));
    options_.log(LOCUS_LOG_INFO, text, options_.log_user);
}

bool Store::hand_over() {
    publish_figures();
    const bool completely = departures_.hand_over();
    publish_figures();
    return completely;
}

void Store::publish_figures() {
    const LayoutStats layout = layout_->stats();
    locus_pmq_stats stats{};
    stats.struct_size = sizeof stats;
    stats.stored = layout.stored;
    stats.pending = departures_.pending();
    stats.slots = layout.slots;
    stats.bytes = layout.bytes + departures_.bytes() + keys_.capacity() * sizeof(uint64_t) + clamped_.capacity();
    stats.inserted = inserted_;
    stats.evicted = evicted_;
    stats.erased = erased_;
    stats.batches = batches_;
    stats.moved = layout.moved;
    stats.rebalances = layout.rebalances;
    stats.grows = layout.grows;
    stats.shrinks = layout.shrinks;
    stats.longest_pause_ns = longest_pause_ns_;
    stats.density = layout.slots == 0 ? 0.0 : static_cast<double>(layout.stored) / static_cast<double>(layout.slots);
    stats.now = now_;
    const std::lock_guard lock(figures_mutex_);
    figures_ = stats;
}

locus_pmq_stats Store::stats() const {
    locus_pmq_stats stats;
    {
        const std::lock_guard lock(figures_mutex_);
        stats = figures_;
    }
    stats.records = pmq::count(*view(), {});
    return stats;
}

void Store::check() const {
    const Writing writing(*this);
    layout_->check();
    const uint64_t gone = evicted_ + erased_, stored = layout_->stats().stored;
    if (inserted_ - gone != stored)
        fail(LOCUS_E_INTERNAL, "store: ", inserted_, " records came in and ", gone, " left, but ", stored,
             " are stored");
}

} // namespace locus::pmq
