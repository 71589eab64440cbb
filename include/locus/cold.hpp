/* locus/cold.hpp - locus::cold, the owner of a locus_cold (liblocus_cold): see locus/cold.h for what is kept, when, and
 * errors. Not part of locus/locus.hpp: programs that keep the live window only link without SQLite.
 *
 *     locus::cold<> tier("posts.db");
 *     locus::pmq_options<> window;
 *     window.horizon = hour;
 *     tier.attach(window);
 *     locus::pmq<> store(window); // what it lets go is the tier's
 *     tier.count(store, query);   // both, at one moment
 *
 * The tier is made before its store and ends after it. */
#ifndef LOCUS_COLD_HPP
#define LOCUS_COLD_HPP

#include <locus/cold.h>
#include <locus/pmq.hpp>

namespace locus {

/* The C options with their defaults. */
template <class Record = locus_point32>
struct cold_options : locus_cold_options {
    cold_options() noexcept {
        locus_cold_options_init(this, sizeof(locus_cold_options));
        record = record_layout<Record>::value;
    }
};

template <class Record = locus_point32>
class cold {
public:
    using query = locus::query<Record>;

    /* An empty handle: only assigning to it and destroying it are allowed. */
    cold() noexcept = default;
    explicit cold(const std::string &path, const cold_options<Record> &options = {}, status *result = nullptr) {
        locus_cold *made = nullptr;
        const locus_status code = locus_cold_open(path.c_str(), &options, &made);
        handle_.reset(made);
        settle(code, result);
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_cold *get() const noexcept { return handle_.get(); }

    /* Let the store that is made with these options hand what it lets go to this tier: they have no other sink. */
    void attach(pmq_options<Record> &options, status *result = nullptr) {
        if (options.sink)
            detail::settle(LOCUS_E_ARGUMENT, result,
                           "locus::cold::attach: options.sink is set, and a store has one sink");
        else
            settle(locus_cold_attach(get(), &options), result);
    }

    /* Questions to the attached store and the tier, as of one moment; without a store, to the tier alone. */
    std::uint64_t count(const pmq<Record> &store, const query &what = {}, status *result = nullptr) const {
        return counted(store.get(), what, result);
    }
    std::uint64_t count(const query &what = {}, status *result = nullptr) const {
        return counted(nullptr, what, result);
    }
    /* Read into memory of yours; returns how many there are, also with LOCUS_E_CAPACITY. */
    std::size_t read(span<Record> into, const pmq<Record> &store, const query &what = {},
                     status *result = nullptr) const {
        return filled(into, store.get(), what, result);
    }
    std::size_t read(span<Record> into, const query &what = {}, status *result = nullptr) const {
        return filled(into, nullptr, what, result);
    }
    /* Read into a new vector; beside a writer, until it is large enough. */
    std::vector<Record> read(const pmq<Record> &store, const query &what = {}, status *result = nullptr) const {
        return all(store.get(), what, result);
    }
    std::vector<Record> read(const query &what = {}, status *result = nullptr) const {
        return all(nullptr, what, result);
    }
    /* Show the records to a lambda; false stops, and the status is LOCUS_E_STOPPED. It must not call into the tier or
     * change the store. */
    void visit(const callback<bool(const Record &)> &visitor, const pmq<Record> &store, const query &what = {},
               status *result = nullptr) const {
        shown(visitor, store.get(), what, result);
    }
    void visit(const callback<bool(const Record &)> &visitor, const query &what = {}, status *result = nullptr) const {
        shown(visitor, nullptr, what, result);
    }

    /* Wait until what has been taken over by now is in the file. */
    void flush(status *result = nullptr) { settle(locus_cold_flush(get()), result); }
    /* Set the tier's clock, and let go what is older than options.max_age. */
    void sweep(std::int64_t now, status *result = nullptr) { settle(locus_cold_sweep(get(), now), result); }
    /* Forget what was taken over when stats().received had been `received` or more. */
    void rewind(std::uint64_t received, status *result = nullptr) {
        settle(locus_cold_rewind(get(), received), result);
    }
    locus_cold_stats stats(status *result = nullptr) const {
        locus_cold_stats stats{};
        stats.struct_size = sizeof stats;
        settle(locus_cold_get_stats(get(), &stats), result);
        return stats;
    }
    /* Verify the whole file. */
    void check(status *result = nullptr) const { settle(locus_cold_check(get()), result); }

private:
    /* liblocus_cold keeps its error texts apart. */
    static void settle(locus_status code, status *result) { detail::settle(code, result, locus_cold_last_error()); }

    std::uint64_t counted(const locus_pmq *store, const query &what, status *result) const {
        std::uint64_t count = 0;
        typename query::asked asked(what);
        const locus_status code = locus_cold_count(get(), store, asked.get(), &count);
        asked.rethrow();
        settle(code, result);
        return count;
    }
    std::size_t filled(span<Record> into, const locus_pmq *store, const query &what, status *result) const {
        std::size_t count = 0;
        typename query::asked asked(what);
        const locus_status code = locus_cold_read(get(), store, asked.get(), into.data(), into.size(), &count);
        asked.rethrow();
        settle(code, result);
        return count;
    }
    std::vector<Record> all(const locus_pmq *store, const query &what, status *result) const {
        return detail::read_all<Record>(
            [&](status *state) { return counted(store, what, state); },
            [&](span<Record> into, status *state) { return filled(into, store, what, state); }, result);
    }
    void shown(const callback<bool(const Record &)> &visitor, const locus_pmq *store, const query &what,
               status *result) const {
        typename query::asked asked(what);
        detail::visit_call<Record> call{visitor, {}};
        const locus_status code = locus_cold_visit(get(), store, asked.get(), call.at, &call);
        call.thrown.rethrow();
        asked.rethrow();
        settle(code, result);
    }

    std::unique_ptr<locus_cold, detail::ended_by<locus_cold_close>> handle_;
};

} // namespace locus
#endif
