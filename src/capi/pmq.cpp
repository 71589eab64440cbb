// locus/pmq.h
#include "capi/boundary.hpp"
#include "core/options.hpp"
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/store.hpp"

#include <optional>

using locus::boundary;
using locus::need;
using locus::require;
using namespace locus::pmq;

struct locus_pmq {
    std::shared_ptr<Store> store;
};

struct locus_pmq_snapshot {
    std::shared_ptr<Store> store; // kept alive
    std::shared_ptr<const Snapshot> moment;
};

static_assert(sizeof(locus_pmq_options) == 144, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_query) == 88, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_stats) == 136, "append only; then update the ABI baseline");

namespace {

constexpr size_t first_options_size = 144, first_query_size = 88, first_stats_size = 136;

locus_pmq_query default_query() noexcept {
    locus_pmq_query query{};
    query.struct_size = sizeof query;
    query.region = LOCUS_REGION_ALL;
    query.time_from = INT64_MIN;
    query.time_to = INT64_MAX;
    return query;
}

// A caller's query and the region it asks for.
class Question {
public:
    explicit Question(const locus_pmq_query *query) {
        const locus_pmq_query whole = locus::read_options(query, default_query(), first_query_size);
        require(whole.region == LOCUS_REGION_ALL || whole.region == LOCUS_REGION_BOX, "query.region is ", whole.region,
                ", not a LOCUS_REGION_");
        require(whole.reserved0 == 0, "query.reserved0 is ", whole.reserved0, ", not 0");
        require(whole.time_from <= whole.time_to, "query.time_from is ", whole.time_from, ", after time_to, ",
                whole.time_to);
        if (whole.region == LOCUS_REGION_BOX)
            selection_.region = &box_.emplace(whole.box);
        selection_.times = {whole.time_from, whole.time_to};
        selection_.filter = whole.filter;
        selection_.filter_user = whole.filter_user;
        snapshot_ = whole.snapshot;
    }
    Question(const Question &) = delete;
    Question &operator=(const Question &) = delete;
    const Selection &selection() const noexcept { return selection_; }
    const locus_pmq_snapshot *snapshot() const noexcept { return snapshot_; }
    // What is to be asked.
    std::shared_ptr<const View> view(const locus_pmq &pmq) const {
        if (snapshot_ == nullptr)
            return pmq.store->view();
        require(snapshot_->store == pmq.store, "query.snapshot is another store's");
        return snapshot_->moment->view();
    }

private:
    std::optional<BoxRegion> box_;
    Selection selection_;
    const locus_pmq_snapshot *snapshot_ = nullptr;
};

// What ran until one of the caller's callbacks stopped it.
void finished(bool completely, const char *callbacks) {
    if (!completely)
        locus::fail(LOCUS_E_STOPPED, "stopped by the caller's ", callbacks);
}

template <typename T>
void store_to(T *target, T value) noexcept {
    if (target)
        *target = value;
}

} // namespace

locus_status locus_pmq_options_init(locus_pmq_options *options, size_t size) noexcept {
    return boundary(__func__, [&] { locus::init_options(options, size, default_options(), first_options_size); });
}

locus_status locus_pmq_query_init(locus_pmq_query *query, size_t size) noexcept {
    return boundary(__func__, [&] { locus::init_options(query, size, default_query(), first_query_size, "query"); });
}

locus_status locus_pmq_key(double latitude, double longitude, uint64_t *key) noexcept {
    return boundary(__func__, [&] {
        need(key, "key");
        require(latitude >= -90 && latitude <= 90, "latitude is ", latitude, ", not within -90..90");
        require(longitude >= -180 && longitude <= 180, "longitude is ", longitude, ", not within -180..180");
        *key = locus::key_of(latitude, longitude);
    });
}

locus_status locus_pmq_create(const locus_pmq_options *options, locus_pmq **pmq) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq") = nullptr;
        *pmq =
            new locus_pmq{std::make_shared<Store>(locus::read_options(options, default_options(), first_options_size))};
    });
}

void locus_pmq_destroy(locus_pmq *pmq) noexcept { delete pmq; }

locus_status locus_pmq_insert(locus_pmq *pmq, const void *records, size_t count, int64_t now) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        require(records != nullptr || count == 0, "records is NULL, count is ", count);
        finished(pmq->store->insert(static_cast<const std::byte *>(records), count, now), "remove or sink");
    });
}

locus_status locus_pmq_sweep(locus_pmq *pmq, int64_t now, uint64_t *evicted) noexcept {
    return boundary(__func__, [&] {
        uint64_t number = 0;
        const bool completely = need(pmq, "pmq").store->sweep(now, number);
        store_to(evicted, number);
        finished(completely, "remove or sink");
    });
}

locus_status locus_pmq_erase(locus_pmq *pmq, const locus_pmq_query *query, uint64_t *erased) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        const Question question(query);
        require(question.snapshot() == nullptr, "query.snapshot is set: erasing is of the present");
        uint64_t number = 0;
        const bool completely = pmq->store->erase(question.selection(), number);
        store_to(erased, number);
        finished(completely, "sink");
    });
}

locus_status locus_pmq_snapshot_create(const locus_pmq *pmq, locus_pmq_snapshot **snapshot) noexcept {
    return boundary(__func__, [&] {
        need(snapshot, "snapshot") = nullptr;
        const std::shared_ptr<Store> &store = need(pmq, "pmq").store;
        *snapshot = new locus_pmq_snapshot{store, store->snapshot()};
    });
}

void locus_pmq_snapshot_destroy(locus_pmq_snapshot *snapshot) noexcept { delete snapshot; }

locus_status locus_pmq_count(const locus_pmq *pmq, const locus_pmq_query *query, uint64_t *count) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(count, "count");
        const Question question(query);
        *count = locus::pmq::count(*question.view(*pmq), question.selection());
    });
}

locus_status locus_pmq_read(const locus_pmq *pmq, const locus_pmq_query *query, void *records, size_t capacity,
                            size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(count, "count");
        require(records != nullptr || capacity == 0, "records is NULL, capacity is ", capacity);
        const Question question(query);
        *count = read(*question.view(*pmq), question.selection(), static_cast<std::byte *>(records), capacity);
        if (*count > capacity)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", *count, " records");
    });
}

locus_status locus_pmq_visit(const locus_pmq *pmq, const locus_pmq_query *query, locus_visit_fn visit,
                             void *user) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(visit, "visit");
        const Question question(query);
        finished(locus::pmq::visit(*question.view(*pmq), question.selection(), visit, user), "visit");
    });
}

locus_status locus_pmq_tile(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins,
                            const locus_pmq_query *query, uint32_t *bins, size_t capacity, uint64_t *total) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(bins, "bins");
        require(zoom <= locus::key_levels, "zoom is ", zoom, ", above ", locus::key_levels);
        const uint32_t tiles = uint32_t{1} << zoom;
        require(x < tiles, "x is ", x, ", zoom ", zoom, " has columns 0..", tiles - 1);
        require(y < tiles, "y is ", y, ", zoom ", zoom, " has rows 0..", tiles - 1);
        require(log2_bins <= 8, "log2_bins is ", log2_bins, ", above 8");
        const Question question(query);
        if (question.selection().region)
            locus::fail(LOCUS_E_ARGUMENT, "query.region is ", query->region,
                        ", not LOCUS_REGION_ALL: a tile has its own region");
        const size_t number = size_t{1} << (2 * log2_bins);
        if (capacity < number)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", number, " bins");
        const uint64_t sum = tile(*question.view(*pmq), question.selection(), locus::Quadrant::of_tile(zoom, x, y),
                                  log2_bins, {bins, number});
        store_to(total, sum);
    });
}

locus_status locus_pmq_get_stats(const locus_pmq *pmq, locus_pmq_stats *stats) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(stats, "stats");
        locus::write_report(stats, pmq->store->stats(), first_stats_size, "stats");
    });
}

locus_status locus_pmq_check(const locus_pmq *pmq) noexcept {
    return boundary(__func__, [&] { need(pmq, "pmq").store->check(); });
}
