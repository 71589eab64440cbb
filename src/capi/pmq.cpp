// locus/pmq.h
#include "capi/boundary.hpp"
#include "capi/pmq_handles.hpp"
#include "core/options.hpp"
#include "pmq/options.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/query/ranking.hpp"

#include <algorithm>
#include <memory>

using locus::boundary;
using locus::need;
using locus::Question;
using locus::require;
using namespace locus::pmq;

static_assert(sizeof(locus_pmq_options) == 144, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_query) == 152, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_score) == 48, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_stats) == 136, "append only; then update the ABI baseline");
static_assert(LOCUS_KEY_END == locus::key_end);

namespace {

constexpr size_t first_score_size = 48, first_stats_size = 136;

// A query of a tile, whose region it is, with the bins that it needs.
class TileQuestion : public Question {
public:
    TileQuestion(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins,
                 const locus_pmq_query *query, size_t capacity)
        : Question(query), tile(locus::Quadrant::of_tile(zoom, x, y)), bins(size_t{1} << (2 * (log2_bins & 15))) {
        need(pmq, "pmq");
        require(zoom <= locus::key_levels, "zoom is ", zoom, ", above ", locus::key_levels);
        const uint32_t tiles = uint32_t{1} << zoom;
        require(x < tiles, "x is ", x, ", zoom ", zoom, " has columns 0..", tiles - 1);
        require(y < tiles, "y is ", y, ", zoom ", zoom, " has rows 0..", tiles - 1);
        require(log2_bins <= 8, "log2_bins is ", log2_bins, ", above 8");
        if (selection().region)
            locus::fail(LOCUS_E_ARGUMENT, "query.region is ", query->region,
                        ", not LOCUS_REGION_ALL: a tile has its own region");
        if (capacity < bins)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", bins, " bins");
    }
    const locus::Quadrant tile;
    const size_t bins;
};

// How locus_pmq_groups tells records apart.
struct Field {
    size_t offset;        // in a locus_point32,
    locus_group_fn group; // or the caller's function
    void *user;

    Field(uint32_t field, const RecordFormat &format, locus_group_fn caller, void *caller_user)
        : offset(0), group(nullptr), user(caller_user) {
        constexpr size_t offsets[] = {offsetof(locus_point32, device), offsetof(locus_point32, application),
                                      offsetof(locus_point32, language)};
        require(field <= LOCUS_FIELD_CALLER, "field is ", field, ", not a LOCUS_FIELD_");
        if (field == LOCUS_FIELD_CALLER)
            group = &need(caller, "group");
        else if (format.size != LOCUS_RECORD_POINT32)
            locus::fail(LOCUS_E_UNSUPPORTED, "field is ", field, ", which records of ", format.size, " bytes have not");
        else
            offset = offsets[field];
    }
    uint64_t operator()(Bytes record) const {
        if (group)
            return group(record, user);
        uint16_t value;
        std::memcpy(&value, record + offset, sizeof value);
        return value;
    }
};

locus_pmq_score default_score() noexcept {
    locus_pmq_score score{};
    score.struct_size = sizeof score;
    score.radius = 30000;
    score.alpha = 0.2;
    score.period = 10'000'000'000;
    return score;
}

Ranking ranking_of(const locus_pmq_score &score) {
    check_degrees(score.latitude, 90, "score.latitude");
    check_degrees(score.longitude, 180, "score.longitude");
    require(score.radius > 0 && score.radius <= locus::half_globe(), "score.radius is ", score.radius,
            ", not above 0 and up to ", locus::half_globe(), " metres, half the globe");
    require(score.alpha >= 0 && score.alpha <= 1, "score.alpha is ", score.alpha, ", not within 0..1");
    require(score.period > 0, "score.period is ", score.period, ", not above 0");
    return {{score.latitude, score.longitude}, score.alpha,  score.radius,
            static_cast<double>(score.period), score.radius, static_cast<uint64_t>(score.period)};
}

// Copy the best records and their scores to the caller; a query without a region.
void rank(const locus_pmq *pmq, const Ranking &ranking, const locus_pmq_query *query, size_t k, void *records,
          double *scores, size_t *count) {
    need(pmq, "pmq");
    require(records != nullptr, "records is NULL");
    need(count, "count");
    require(k > 0, "k is 0");
    const Question question(query);
    require(question.selection().region == nullptr,
            "query.region is set, not LOCUS_REGION_ALL: a ranking has its own region");
    const auto view = question.view(*pmq);
    const std::vector<Ranked> found = best(*view, question.selection(), ranking, k);
    const size_t size = view->format().size;
    for (size_t i = 0; i < found.size(); ++i) {
        std::memcpy(static_cast<std::byte *>(records) + i * size, found[i].record, size);
        if (scores)
            scores[i] = found[i].score;
    }
    *count = found.size();
}

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
    return boundary(__func__,
                    [&] { locus::init_options(options, size, default_options(), locus::first_pmq_options_size); });
}

locus_status locus_pmq_query_init(locus_pmq_query *query, size_t size) noexcept {
    return boundary(
        __func__, [&] { locus::init_options(query, size, locus::default_query(), locus::first_query_size, "query"); });
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
        *pmq = new locus_pmq{
            std::make_shared<Store>(locus::read_options(options, default_options(), locus::first_pmq_options_size))};
    });
}

void locus_pmq_destroy(locus_pmq *pmq) noexcept { delete pmq; }

locus_status locus_pmq_insert(locus_pmq *pmq, const void *records, size_t count, int64_t now) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        require(records != nullptr || count == 0, "records is NULL, count is ", count);
        finished(pmq->store->insert(static_cast<const std::byte *>(records), count, now),
                 "remove, sink, alert or fence");
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
        require(!question.selection().expired, "query.expired is 1: erasing is of live records");
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
        *count = read(*question.view(*pmq), question.selection(), question.order(), static_cast<std::byte *>(records),
                      capacity);
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
        finished(locus::pmq::visit(*question.view(*pmq), question.selection(), question.order(), visit, user), "visit");
    });
}

locus_status locus_pmq_read_page(const locus_pmq *pmq, const locus_pmq_query *query, locus_pmq_cursor *cursor,
                                 void *records, size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(cursor, "cursor");
        need(count, "count");
        require(records != nullptr, "records is NULL");
        require(capacity > 0, "capacity is 0");
        const Question question(query);
        const bool lasting = question.snapshot() != nullptr;
        require(cursor->key <= LOCUS_KEY_END, "cursor->key is ", cursor->key, ", beyond LOCUS_KEY_END");
        require(lasting || cursor->passed == 0, "cursor->passed is ", cursor->passed,
                ", not 0: the cursor is a snapshot's");
        *count = read_page(*question.view(*pmq), question.selection(), lasting, *cursor,
                           static_cast<std::byte *>(records), capacity, *count);
    });
}

locus_status locus_pmq_groups(const locus_pmq *pmq, const locus_pmq_query *query, uint32_t field, locus_group_fn group,
                              void *user, locus_pmq_group *groups, size_t capacity, size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(count, "count");
        require(groups != nullptr || capacity == 0, "groups is NULL, capacity is ", capacity);
        const Question question(query);
        const auto view = question.view(*pmq);
        const std::vector<locus_pmq_group> found =
            locus::pmq::groups(*view, question.selection(), Field(field, view->format(), group, user));
        std::copy_n(found.begin(), std::min(found.size(), capacity), groups);
        *count = found.size();
        if (found.size() > capacity)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", found.size(), " groups");
    });
}

locus_status locus_pmq_tile(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins,
                            const locus_pmq_query *query, uint32_t *bins, size_t capacity, uint64_t *total) noexcept {
    return boundary(__func__, [&] {
        need(bins, "bins");
        const TileQuestion question(pmq, zoom, x, y, log2_bins, query, capacity);
        const uint64_t sum =
            tile(*question.view(*pmq), question.selection(), question.tile, log2_bins, {bins, question.bins});
        store_to(total, sum);
    });
}

locus_status locus_pmq_weighted_tile(const locus_pmq *pmq, uint32_t zoom, uint32_t x, uint32_t y, uint32_t log2_bins,
                                     const locus_pmq_query *query, locus_record_weight_fn weight, void *user,
                                     double *bins, size_t capacity, double *total) noexcept {
    return boundary(__func__, [&] {
        need(weight, "weight");
        need(bins, "bins");
        const TileQuestion question(pmq, zoom, x, y, log2_bins, query, capacity);
        const double sum = weighted_tile(*question.view(*pmq), question.selection(), question.tile, log2_bins, weight,
                                         user, {bins, question.bins});
        store_to(total, sum);
    });
}

locus_status locus_pmq_score_init(locus_pmq_score *score, size_t size) noexcept {
    return boundary(__func__, [&] { locus::init_options(score, size, default_score(), first_score_size, "score"); });
}

locus_status locus_pmq_topk(const locus_pmq *pmq, const locus_pmq_score *score, const locus_pmq_query *query, size_t k,
                            void *records, double *scores, size_t *count) noexcept {
    return boundary(__func__, [&] {
        const auto whole = locus::read_options(&need(score, "score"), default_score(), first_score_size);
        rank(pmq, ranking_of(whole), query, k, records, scores, count);
    });
}

// By distance alone, in metres.
locus_status locus_pmq_nearest(const locus_pmq *pmq, double latitude, double longitude, const locus_pmq_query *query,
                               size_t k, void *records, double *distances, size_t *count) noexcept {
    return boundary(__func__, [&] {
        check_degrees(latitude, 90, "latitude");
        check_degrees(longitude, 180, "longitude");
        const Ranking ranking{{latitude, longitude}, 1, 1, 1, 2 * locus::half_globe(), UINT64_MAX};
        rank(pmq, ranking, query, k, records, distances, count);
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
