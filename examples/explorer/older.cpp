// Opening the tier where the store goes on.
#include "explorer/older.hpp"

#include "explorer/selection.hpp"

#include <stdexcept>

namespace explorer {
namespace {

// A full queue holds the writer up for one transaction: a fraction of a second.
constexpr uint64_t batch_records = 65'536;
constexpr int64_t clock_step = 1'000'000; // microseconds

} // namespace

// The tier can tell its sink only after it has been rewound, and how far is known only once the store is open; until
// then nothing is taken.
void Older::listen(locus_pmq_options &options) {
    options.sink = take;
    options.sink_user = this;
}

int32_t Older::take(const void *record, void *user) {
    const auto &self = *static_cast<const Older *>(user);
    return self.sink_ == nullptr ? 1 : self.sink_(record, self.sink_user_);
}

void Older::join(const std::string &folder, const locus_pmq_recovery &recovery, locus_pmq *store) {
    marks_ = std::make_unique<Marks>(folder);
    open(folder + "/older.db");
    rewind(recovery.number);
    locus_pmq_options options;
    check(locus_pmq_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    check_cold(locus_cold_attach(tier_.get(), &options));
    sink_user_ = options.sink_user;
    sink_ = options.sink;
    clock_ = stats().now;
    if (recovery.now == INT64_MIN)
        return;
    const locus_status status = locus_pmq_sweep(store, recovery.now, nullptr);
    if (status == LOCUS_E_STOPPED)
        check_cold(locus_cold_flush(tier_.get())); // it tells why it takes no more
    check(status);
}

void Older::open(const std::string &path) {
    locus_cold_options options;
    check_cold(locus_cold_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    options.when_full = LOCUS_COLD_FULL_WAIT;
    options.batch_records = batch_records;
    options.max_age = settings_.max_age;
    options.max_bytes = settings_.max_bytes;
    locus_cold *tier = nullptr;
    check_cold(locus_cold_open(path.c_str(), &options, &tier));
    tier_.reset(tier);
}

// Without a mark the file was saved by a run that kept nothing, and what the tier has is from before.
void Older::rewind(uint64_t number) {
    latest_ = number;
    const auto mark = marks_->find(number);
    const uint64_t received = stats().received;
    if (mark && *mark > received)
        throw std::runtime_error(marks_->path() + ": older.db had taken over " + std::to_string(*mark) +
                                 " records when the window was saved, and has " + std::to_string(received) +
                                 ": it is another file");
    if (mark)
        check_cold(locus_cold_rewind(tier_.get(), *mark));
    else
        marks_->keep(number, received, least_);
}

void Older::advance(int64_t now) {
    if (clock_ != INT64_MIN && now < clock_ + clock_step)
        return;
    check_cold(locus_cold_sweep(tier_.get(), now));
    clock_ = now;
}

void Older::mark(uint64_t number, uint64_t received) {
    check_cold(locus_cold_flush(tier_.get()));
    marks_->keep(number, received, least_);
}

void Older::saved(uint64_t number) {
    least_ = latest_; // the folder keeps one file beside the newest
    latest_ = number;
}

locus_cold_stats Older::stats() const {
    locus_cold_stats stats{};
    stats.struct_size = sizeof stats;
    check_cold(locus_cold_get_stats(tier_.get(), &stats));
    return stats;
}

} // namespace explorer
