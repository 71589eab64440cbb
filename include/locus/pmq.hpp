/* locus/pmq.hpp - locus::pmq, the owner of a locus_pmq, its queries and snapshots. Each member is the C function of its
 * name: see locus/pmq.h for units, ranges, threads and errors. */
#ifndef LOCUS_PMQ_HPP
#define LOCUS_PMQ_HPP

#include <locus/pmq.h>
#include <locus/status.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace locus {

/* The layouts a store can hold, as C structs. */
template <class Record>
struct record_layout;
template <>
struct record_layout<locus_point32> {
    static constexpr std::uint32_t value = LOCUS_RECORD_POINT32;
};
template <>
struct record_layout<locus_text156> {
    static constexpr std::uint32_t value = LOCUS_RECORD_TEXT156;
};

/* The C options with their defaults; the callbacks are lambdas. */
template <class Record = locus_point32>
struct pmq_options : locus_pmq_options {
    pmq_options() noexcept {
        locus_pmq_options_init(this, sizeof(locus_pmq_options));
        record = record_layout<Record>::value;
    }
    callback<bool(const Record &)> remove; /* true: the record may go */
    callback<bool(const Record &)> sink;   /* takes over a record that left; false stops, an exception too */
    locus::log log;
};

/* A polygon that owns its rings. */
class polygon {
public:
    polygon() = default;
    explicit polygon(span<const locus_position> ring) { add(ring); }
    polygon &add(span<const locus_position> ring) {
        vertices_.insert(vertices_.end(), ring.begin(), ring.end());
        ring_sizes_.push_back(ring.size());
        return *this;
    }
    locus_polygon get() const noexcept { return {vertices_.data(), ring_sizes_.data(), ring_sizes_.size()}; }

private:
    std::vector<locus_position> vertices_;
    std::vector<std::uint64_t> ring_sizes_;
};

/* One moment of a store, for several queries. */
class snapshot {
public:
    /* An empty handle: only assigning to it and destroying it are allowed. */
    snapshot() noexcept = default;
    explicit snapshot(const locus_pmq *store, status *result = nullptr) {
        locus_pmq_snapshot *made = nullptr;
        const locus_status code = locus_pmq_snapshot_create(store, &made);
        handle_.reset(made);
        detail::settle(code, result);
    }
    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_pmq_snapshot *get() const noexcept { return handle_.get(); }

private:
    std::unique_ptr<locus_pmq_snapshot, detail::ended_by<locus_pmq_snapshot_destroy>> handle_;
};

/* What to look for: everything, until it is narrowed. query<>().in(box).between(from, to).where(lambda) */
template <class Record = locus_point32>
class query {
public:
    query() noexcept { locus_pmq_query_init(&plain_, sizeof plain_); }
    query &in(const locus_box &box) {
        plain_.region = LOCUS_REGION_BOX;
        plain_.box = box;
        return *this;
    }
    query &in(const locus_circle &circle) {
        plain_.region = LOCUS_REGION_CIRCLE;
        plain_.circle = circle;
        return *this;
    }
    query &in(polygon rings) {
        plain_.region = LOCUS_REGION_POLYGON;
        polygon_ = std::move(rings);
        return *this;
    }
    /* Microseconds, both included. */
    query &between(std::int64_t from, std::int64_t to) {
        plain_.time_from = from;
        plain_.time_to = to;
        return *this;
    }
    /* Only records that the lambda says true to. */
    query &where(callback<bool(const Record &)> filter) {
        filter_ = std::move(filter);
        return *this;
    }
    /* Records that have expired and have not left the store yet, too. Not for pmq::erase. */
    query &expired() {
        plain_.expired = 1;
        return *this;
    }
    /* Records need not come in the store's order, which is quicker. */
    query &in_any_order() {
        plain_.order = LOCUS_ORDER_ANY;
        return *this;
    }
    /* Ask a snapshot of the store, which must live until the query is asked. */
    query &at(const snapshot &moment) {
        plain_.snapshot = moment.get();
        return *this;
    }

    /* The query for one call of the C interface; rethrow afterwards what the filter threw. */
    class asked {
    public:
        /* What the filter throws goes to `elsewhere`, if that is given. */
        explicit asked(const query &query, detail::thrown *elsewhere = nullptr)
            : plain_(query.plain_), filter_(query.filter_), thrown_(elsewhere != nullptr ? *elsewhere : own_) {
            plain_.polygon = query.polygon_.get();
            if (filter_) {
                plain_.filter = accepts;
                plain_.filter_user = this;
            }
        }
        asked(const asked &) = delete;
        asked &operator=(const asked &) = delete;
        const locus_pmq_query *get() const noexcept { return &plain_; }
        void rethrow() { thrown_.rethrow(); }

    private:
        static std::int32_t accepts(const void *record, void *user) noexcept {
            auto &call = *static_cast<asked *>(user);
            return call.thrown_.guard(std::int32_t{0},
                                      [&] { return call.filter_(*static_cast<const Record *>(record)) ? 1 : 0; });
        }
        locus_pmq_query plain_;
        const callback<bool(const Record &)> &filter_;
        detail::thrown own_;
        detail::thrown &thrown_;
    };

private:
    locus_pmq_query plain_{};
    polygon polygon_;
    callback<bool(const Record &)> filter_;
};

/* The key of a place. */
inline std::uint64_t pmq_key(double latitude, double longitude, status *result = nullptr) {
    std::uint64_t key = 0;
    detail::settle(locus_pmq_key(latitude, longitude, &key), result);
    return key;
}

/* A score with its defaults. */
struct pmq_score : locus_pmq_score {
    pmq_score() noexcept { locus_pmq_score_init(this, sizeof(locus_pmq_score)); }
    pmq_score(double at_latitude, double at_longitude) noexcept : pmq_score() {
        latitude = at_latitude, longitude = at_longitude;
    }
};

/* Records and what they scored, or how far they are in metres, best first. */
template <class Record>
struct ranked {
    std::vector<Record> records;
    std::vector<double> values;
};

namespace detail {
struct storage;

/* A visitor during one call. */
template <class Record>
struct visit_call {
    const callback<bool(const Record &)> &visitor;
    detail::thrown thrown;
    static std::int32_t at(const void *record, void *user) noexcept {
        auto &call = *static_cast<visit_call *>(user);
        return call.thrown.guard(std::int32_t{1},
                                 [&] { return call.visitor(*static_cast<const Record *>(record)) ? 0 : 1; });
    }
};

/* Read into a vector that is made as large as `count` says and `read` finds. */
template <class Record, class Count, class Read>
std::vector<Record> read_all(Count &&count, Read &&read, status *result) {
    status state;
    std::vector<Record> records;
    std::size_t found = static_cast<std::size_t>(count(&state));
    while (state.ok()) {
        records.resize(found);
        found = read(span<Record>(records), &state);
        if (state.code() != LOCUS_E_CAPACITY)
            break;
        state = {};
    }
    records.resize(state.ok() ? found : 0);
    settle(state.code(), result, state.text());
    return records;
}
} // namespace detail
template <class Record>
class alerts;

template <class Record = locus_point32>
class pmq {
public:
    using query = locus::query<Record>;

    explicit pmq(const pmq_options<Record> &options = {}, status *result = nullptr) {
        make(options, result,
             [](const locus_pmq_options &plain, locus_pmq **made) { return locus_pmq_create(&plain, made); });
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_pmq *get() const noexcept { return handle_.get(); }

    void insert(span<const Record> records, std::int64_t now, status *result = nullptr) {
        settle(locus_pmq_insert(get(), records.data(), records.size(), now), result);
    }
    /* Sweeping and erasing return the number of records that left. */
    std::uint64_t sweep(std::int64_t now, status *result = nullptr) {
        std::uint64_t evicted = 0;
        settle(locus_pmq_sweep(get(), now, &evicted), result);
        return evicted;
    }
    std::uint64_t erase(const query &what, status *result = nullptr) {
        std::uint64_t erased = 0;
        typename query::asked asked(what);
        const locus_status code = locus_pmq_erase(get(), asked.get(), &erased);
        asked.rethrow();
        settle(code, result);
        return erased;
    }

    std::uint64_t count(const query &what = {}, status *result = nullptr) const {
        std::uint64_t count = 0;
        typename query::asked asked(what);
        const locus_status code = locus_pmq_count(get(), asked.get(), &count);
        answer(asked, code, result);
        return count;
    }
    /* Read into memory of yours; returns how many there are, also with LOCUS_E_CAPACITY. */
    std::size_t read(span<Record> into, const query &what = {}, status *result = nullptr) const {
        std::size_t count = 0;
        typename query::asked asked(what);
        const locus_status code = locus_pmq_read(get(), asked.get(), into.data(), into.size(), &count);
        answer(asked, code, result);
        return count;
    }
    /* Read into a new vector; beside a writer, until it is large enough. */
    std::vector<Record> read(const query &what = {}, status *result = nullptr) const {
        return detail::read_all<Record>([&](status *state) { return count(what, state); },
                                        [&](span<Record> into, status *state) { return read(into, what, state); },
                                        result);
    }
    /* Show the records to a lambda; false stops, and the status is LOCUS_E_STOPPED. */
    void visit(const callback<bool(const Record &)> &visitor, const query &what = {}, status *result = nullptr) const {
        typename query::asked asked(what);
        detail::visit_call<Record> call{visitor, {}};
        const locus_status code = locus_pmq_visit(get(), asked.get(), call.at, &call);
        call.thrown.rethrow();
        answer(asked, code, result);
    }

    /* Go on in the store's order behind the cursor, into memory of yours; returns how many records, 0 at the end. The
     * room has to reach for the records of one key, see locus_pmq_read_page. */
    std::size_t read_page(locus_pmq_cursor &cursor, span<Record> into, const query &what = {},
                          status *result = nullptr) const {
        std::size_t count = 0;
        typename query::asked asked(what);
        const locus_status code = locus_pmq_read_page(get(), asked.get(), &cursor, into.data(), into.size(), &count);
        answer(asked, code, result);
        return count;
    }
    /* Count by a field, LOCUS_FIELD_, or by what a lambda says of each record; the largest group first. */
    std::vector<locus_pmq_group> groups(std::uint32_t field, const query &what = {}, status *result = nullptr) const {
        return grouped(field, {}, what, result);
    }
    std::vector<locus_pmq_group> groups(const callback<std::uint64_t(const Record &)> &group, const query &what = {},
                                        status *result = nullptr) const {
        return grouped(LOCUS_FIELD_CALLER, group, what, result);
    }

    /* The counts of a tile's bins, row by row from the north-west, 2^log2_bins a side; returns their sum. */
    std::uint64_t tile(span<std::uint32_t> bins, std::uint32_t zoom, std::uint32_t x, std::uint32_t y,
                       std::uint32_t log2_bins, const query &what = {}, status *result = nullptr) const {
        std::uint64_t total = 0;
        typename query::asked asked(what);
        const locus_status code =
            locus_pmq_tile(get(), zoom, x, y, log2_bins, asked.get(), bins.data(), bins.size(), &total);
        answer(asked, code, result);
        return total;
    }
    std::vector<std::uint32_t> tile(std::uint32_t zoom, std::uint32_t x, std::uint32_t y, std::uint32_t log2_bins,
                                    const query &what = {}, status *result = nullptr) const {
        /* The library refuses more than 2^8 bins a side. */
        std::vector<std::uint32_t> bins(std::size_t{1} << 2 * (log2_bins <= 8 ? log2_bins : 0));
        tile(bins, zoom, x, y, log2_bins, what, result);
        return bins;
    }

    /* The same with each record counted as what a lambda says, a finite number. */
    std::vector<double> weighted_tile(const callback<double(const Record &)> &weight, std::uint32_t zoom,
                                      std::uint32_t x, std::uint32_t y, std::uint32_t log2_bins, const query &what = {},
                                      status *result = nullptr) const {
        std::vector<double> bins(std::size_t{1} << 2 * (log2_bins <= 8 ? log2_bins : 0));
        typename query::asked asked(what);
        record_call<double> call{weight, {}};
        const locus_status code =
            locus_pmq_weighted_tile(get(), zoom, x, y, log2_bins, asked.get(), record_call<double>::at, &call,
                                    bins.data(), bins.size(), nullptr);
        call.thrown.rethrow();
        answer(asked, code, result);
        return bins;
    }

    /* The k records with the lowest scores, and the k nearest to a place. */
    ranked<Record> topk(const locus_pmq_score &score, std::size_t k, const query &what = {},
                        status *result = nullptr) const {
        return best(k, what, result,
                    [&](const locus_pmq_query *asked, Record *into, double *values, std::size_t *count) {
                        return locus_pmq_topk(get(), &score, asked, k, into, values, count);
                    });
    }
    ranked<Record> nearest(double latitude, double longitude, std::size_t k, const query &what = {},
                           status *result = nullptr) const {
        return best(k, what, result,
                    [&](const locus_pmq_query *asked, Record *into, double *values, std::size_t *count) {
                        return locus_pmq_nearest(get(), latitude, longitude, asked, k, into, values, count);
                    });
    }

    locus::snapshot snapshot(status *result = nullptr) const { return locus::snapshot(get(), result); }
    locus_pmq_stats stats(status *result = nullptr) const {
        locus_pmq_stats stats{};
        stats.struct_size = sizeof stats;
        detail::settle(locus_pmq_get_stats(get(), &stats), result);
        return stats;
    }
    void check(status *result = nullptr) const { detail::settle(locus_pmq_check(get()), result); }

private:
    friend class alerts<Record>;
    friend struct detail::storage;
    struct callbacks {
        explicit callbacks(const pmq_options<Record> &options)
            : remove(options.remove), sink(options.sink), log(options.log) {}
        callback<bool(const Record &)> remove, sink;
        locus::log log;
        /* Shared with the objects that watch the store: their callbacks are called by its writer too. */
        std::shared_ptr<detail::thrown> thrown = std::make_shared<detail::thrown>();

        static std::int32_t on_remove(const void *record, void *user) noexcept {
            auto &kept = *static_cast<callbacks *>(user);
            return kept.thrown->guard(std::int32_t{-1},
                                      [&] { return kept.remove(*static_cast<const Record *>(record)) ? 1 : 0; });
        }
        static std::int32_t on_sink(const void *record, void *user) noexcept {
            auto &kept = *static_cast<callbacks *>(user);
            return kept.thrown->guard(std::int32_t{1},
                                      [&] { return kept.sink(*static_cast<const Record *>(record)) ? 0 : 1; });
        }
        static void on_log(std::int32_t level, const char *text, void *user) noexcept {
            auto &kept = *static_cast<callbacks *>(user);
            kept.thrown->guard(0, [&] { return kept.log(level, text), 0; });
        }
    };

    /* A lambda that says something of each record; after it has thrown, the rest gets no answer of use. */
    template <class Said>
    struct record_call {
        const callback<Said(const Record &)> &function;
        detail::thrown thrown;
        static Said at(const void *record, void *user) noexcept {
            auto &call = *static_cast<record_call *>(user);
            return call.thrown.guard(Said{}, [&] { return call.function(*static_cast<const Record *>(record)); });
        }
    };

    explicit pmq(std::nullptr_t) noexcept {}
    template <class Create>
    void make(const pmq_options<Record> &options, status *result, Create &&create) {
        locus_pmq_options plain = options;
        if (options.sink && plain.sink != nullptr) {
            detail::settle(LOCUS_E_ARGUMENT, result, "locus::pmq: options.sink is set, and so is that of a cold tier");
            return;
        }
        callbacks_ = std::make_unique<callbacks>(options);
        plain.remove = options.remove ? callbacks::on_remove : nullptr;
        if (options.sink) /* else what locus::cold::attach has set */
            plain.sink = callbacks::on_sink, plain.sink_user = callbacks_.get();
        plain.log = options.log ? callbacks::on_log : nullptr;
        plain.remove_user = plain.log_user = callbacks_.get();
        locus_pmq *made = nullptr;
        const locus_status code = create(plain, &made);
        handle_.reset(made);
        settle(code, result);
    }

    /* What the store's own callbacks threw comes out of the calls of its writer. */
    bool settle(locus_status code, status *result) {
        if (callbacks_ != nullptr)
            callbacks_->thrown->rethrow();
        return detail::settle(code, result);
    }
    static void answer(typename query::asked &asked, locus_status code, status *result) {
        asked.rethrow();
        detail::settle(code, result);
    }
    std::vector<locus_pmq_group> grouped(std::uint32_t field, const callback<std::uint64_t(const Record &)> &group,
                                         const query &what, status *result) const {
        std::vector<locus_pmq_group> found(64);
        std::size_t count = 0;
        locus_status code = LOCUS_E_CAPACITY;
        while (code == LOCUS_E_CAPACITY) {
            found.resize(std::max(found.size(), count));
            typename query::asked asked(what);
            record_call<std::uint64_t> call{group, {}};
            code = locus_pmq_groups(get(), asked.get(), field, group ? record_call<std::uint64_t>::at : nullptr, &call,
                                    found.data(), found.size(), &count);
            call.thrown.rethrow();
            asked.rethrow();
        }
        found.resize(code == LOCUS_OK ? count : 0);
        detail::settle(code, result);
        return found;
    }
    template <class Ask>
    ranked<Record> best(std::size_t k, const query &what, status *result, Ask &&ask) const {
        ranked<Record> found;
        found.records.resize(k);
        found.values.resize(k);
        std::size_t count = 0;
        typename query::asked asked(what);
        const locus_status code = ask(asked.get(), found.records.data(), found.values.data(), &count);
        found.records.resize(code == LOCUS_OK ? count : 0);
        found.values.resize(found.records.size());
        answer(asked, code, result);
        return found;
    }

    /* In this order: the handle ends before what its callbacks use. */
    std::unique_ptr<callbacks> callbacks_;
    std::unique_ptr<locus_pmq, detail::ended_by<locus_pmq_destroy>> handle_;
};

} // namespace locus
#endif
