// locus/cold.h
#include <locus/cold.h>

#include "cold/boundary.hpp"
#include "cold/tier.hpp"
#include "core/options.hpp"

using locus::need;
using locus::require;
using locus::cold::boundary;

struct locus_cold {
    locus::cold::Tier tier;
};

static_assert(sizeof(locus_cold_options) == 80, "append only; then update the ABI baseline");
static_assert(sizeof(locus_cold_stats) == 104, "append only; then update the ABI baseline");

namespace {

constexpr size_t first_options_size = 80, first_stats_size = 104;
constexpr uint64_t mebibyte = uint64_t{1} << 20;

locus_cold_options defaults() noexcept {
    locus_cold_options options{};
    options.struct_size = sizeof options;
    options.record = LOCUS_RECORD_POINT32;
    options.sync = LOCUS_COLD_SYNC_NORMAL;
    options.when_full = LOCUS_COLD_FULL_WAIT;
    options.queue_bytes = 64 * mebibyte;
    options.batch_records = 1 << 18;
    options.delay = 1'000'000;
    options.run_records = 1 << 20;
    options.cache_bytes = 64 * mebibyte;
    options.max_age = LOCUS_NO_HORIZON;
    options.max_bytes = LOCUS_NO_LIMIT;
    return options;
}

locus_cold_options checked(const locus_cold_options *options) {
    const locus_cold_options o = locus::read_options(options, defaults(), first_options_size);
    require(o.record == LOCUS_RECORD_POINT32 || o.record == LOCUS_RECORD_TEXT156, "options.record is ", o.record,
            ", not a LOCUS_RECORD_");
    require(o.sync <= LOCUS_COLD_SYNC_FULL, "options.sync is ", o.sync, ", not a LOCUS_COLD_SYNC_");
    require(o.when_full <= LOCUS_COLD_FULL_REFUSE, "options.when_full is ", o.when_full, ", not a LOCUS_COLD_FULL_");
    require(o.reserved0 == 0, "options.reserved0 is ", o.reserved0, ", not 0");
    require(o.queue_bytes >= mebibyte, "options.queue_bytes is ", o.queue_bytes, ", below 1 MiB");
    require(o.batch_records >= 1 && o.batch_records <= uint64_t{1} << 26, "options.batch_records is ", o.batch_records,
            ", not within 1..2^26");
    require(o.delay > 0, "options.delay is ", o.delay, ", not positive");
    require(o.run_records >= 1 && o.run_records <= uint64_t{1} << 32, "options.run_records is ", o.run_records,
            ", not within 1..2^32");
    require(o.cache_bytes >= mebibyte, "options.cache_bytes is ", o.cache_bytes, ", below 1 MiB");
    require(o.max_age > 0, "options.max_age is ", o.max_age, ", not positive");
    require(o.max_bytes >= 8 * mebibyte, "options.max_bytes is ", o.max_bytes, ", below 8 MiB");
    return o;
}

} // namespace

namespace locus::cold {

ErrorText &last_error_text() noexcept {
    thread_local ErrorText text{};
    return text;
}

} // namespace locus::cold

const char *locus_cold_last_error(void) noexcept { return locus::cold::last_error_text().data(); }

locus_status locus_cold_options_init(locus_cold_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { locus::init_options(options, size, defaults(), first_options_size); });
}

locus_status locus_cold_open(const char *path, const locus_cold_options *options, locus_cold **cold) noexcept {
    return boundary(__func__, [&] {
        need(cold, "cold") = nullptr;
        need(path, "path");
        require(path[0] != '\0', "path is empty");
        *cold = new locus_cold{{path, checked(options)}};
    });
}

void locus_cold_close(locus_cold *cold) noexcept { delete cold; }

locus_status locus_cold_attach(locus_cold *cold, locus_pmq_options *options) noexcept {
    return boundary(__func__, [&] { need(cold, "cold").tier.attach(need(options, "options")); });
}

locus_status locus_cold_count(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query,
                              uint64_t *count) noexcept {
    return boundary(__func__, [&] {
        need(cold, "cold");
        need(count, "count");
        *count = cold->tier.count(pmq, query);
    });
}

locus_status locus_cold_read(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query, void *records,
                             size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(cold, "cold");
        need(count, "count");
        require(records != nullptr || capacity == 0, "records is NULL, capacity is ", capacity);
        auto *to = static_cast<std::byte *>(records);
        const size_t size = cold->tier.record_size();
        size_t found = 0;
        cold->tier.visit(pmq, query, [&](const std::byte *record) {
            if (found < capacity)
                std::memcpy(to + found * size, record, size);
            ++found;
            return true;
        });
        *count = found;
        if (found > capacity)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", found, " records");
    });
}

locus_status locus_cold_visit(locus_cold *cold, const locus_pmq *pmq, const locus_pmq_query *query,
                              locus_visit_fn visit, void *user) noexcept {
    return boundary(__func__, [&] {
        need(cold, "cold");
        need(visit, "visit");
        const bool completely =
            cold->tier.visit(pmq, query, [&](const std::byte *record) { return visit(record, user) == 0; });
        if (!completely)
            locus::fail(LOCUS_E_STOPPED, "stopped by the caller's visit");
    });
}

locus_status locus_cold_flush(locus_cold *cold) noexcept {
    return boundary(__func__, [&] { need(cold, "cold").tier.flush(); });
}

locus_status locus_cold_sweep(locus_cold *cold, int64_t now) noexcept {
    return boundary(__func__, [&] { need(cold, "cold").tier.sweep(now); });
}

locus_status locus_cold_rewind(locus_cold *cold, uint64_t received) noexcept {
    return boundary(__func__, [&] { need(cold, "cold").tier.rewind(received); });
}

locus_status locus_cold_get_stats(const locus_cold *cold, locus_cold_stats *stats) noexcept {
    return boundary(__func__, [&] {
        need(cold, "cold");
        locus::write_report(stats, cold->tier.stats(), first_stats_size, "stats");
    });
}

locus_status locus_cold_check(locus_cold *cold) noexcept {
    return boundary(__func__, [&] { need(cold, "cold").tier.check(); });
}
