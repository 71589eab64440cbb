/* locus/storage.hpp - stores on disk. Each function is the C function of its name: see locus/storage.h for what is
 * kept, when, and errors. */
#ifndef LOCUS_STORAGE_HPP
#define LOCUS_STORAGE_HPP

#include <locus/pmq.hpp>
#include <locus/storage.h>

namespace locus {

struct pmq_log_options : locus_pmq_log_options {
    pmq_log_options() noexcept { locus_pmq_log_options_init(this, sizeof(locus_pmq_log_options)); }
};

namespace detail {

/* What making and changing a store on disk needs of it. */
struct storage {
    template <class Record, class Create>
    static pmq<Record> make(const pmq_options<Record> &options, status *result, progress_call &call, Create &&create) {
        pmq<Record> store(nullptr);
        store.make(options, result, [&](const locus_pmq_options &plain, locus_pmq **made) {
            const locus_status code = create(plain, made);
            if (*made == nullptr)
                call.rethrow();
            return code;
        });
        return store;
    }
    template <class Record>
    static void settle(pmq<Record> &store, locus_status code, progress_call &call, status *result) {
        call.rethrow();
        store.settle(code, result);
    }
};

} // namespace detail

/* Save the present, or a snapshot, as a file. */
template <class Record>
void save(const pmq<Record> &store, const std::string &path, const progress &told = {},
          const snapshot *moment = nullptr, status *result = nullptr) {
    detail::progress_call call(told);
    const locus_status code = locus_pmq_save(store.get(), moment != nullptr ? moment->get() : nullptr, path.c_str(),
                                             detail::progress_call::at, &call);
    call.rethrow();
    detail::settle(code, result);
}

/* Make a store from a saved file. */
template <class Record = locus_point32>
pmq<Record> load(const std::string &path, const pmq_options<Record> &options = {}, const progress &told = {},
                 status *result = nullptr) {
    detail::progress_call call(told);
    return detail::storage::make(options, result, call, [&](const locus_pmq_options &plain, locus_pmq **made) {
        return locus_pmq_load(path.c_str(), &plain, detail::progress_call::at, &call, made);
    });
}

/* Recover the store of a folder, or make a new one, and log every change from now on. */
template <class Record = locus_point32>
pmq<Record> open(const std::string &folder, const pmq_options<Record> &options = {},
                 const pmq_log_options &log_options = {}, const progress &told = {},
                 locus_pmq_recovery *recovery = nullptr, status *result = nullptr) {
    detail::progress_call call(told);
    if (recovery != nullptr)
        recovery->struct_size = sizeof *recovery;
    return detail::storage::make(options, result, call, [&](const locus_pmq_options &plain, locus_pmq **made) {
        return locus_pmq_open(folder.c_str(), &plain, &log_options, detail::progress_call::at, &call, recovery, made);
    });
}

/* Give a store a folder that has none. */
template <class Record>
void attach(pmq<Record> &store, const std::string &folder, const pmq_log_options &log_options = {},
            const progress &told = {}, status *result = nullptr) {
    detail::progress_call call(told);
    const locus_status code =
        locus_pmq_attach(store.get(), folder.c_str(), &log_options, detail::progress_call::at, &call);
    detail::storage::settle(store, code, call, result);
}

/* Save the present moment into the store's folder and begin a new log. */
template <class Record>
void checkpoint(pmq<Record> &store, const progress &told = {}, status *result = nullptr) {
    detail::progress_call call(told);
    const locus_status code = locus_pmq_checkpoint(store.get(), detail::progress_call::at, &call);
    detail::storage::settle(store, code, call, result);
}

/* Flush the log to the disk. */
template <class Record>
void sync(pmq<Record> &store, status *result = nullptr) {
    detail::settle(locus_pmq_sync(store.get()), result);
}

template <class Record>
locus_pmq_log_stats log_stats(const pmq<Record> &store, status *result = nullptr) {
    locus_pmq_log_stats stats{};
    stats.struct_size = sizeof stats;
    detail::settle(locus_pmq_get_log_stats(store.get(), &stats), result);
    return stats;
}

/* What a saved file says of itself. */
inline locus_pmq_file_info file_info(const std::string &path, status *result = nullptr) {
    locus_pmq_file_info info{};
    info.struct_size = sizeof info;
    detail::settle(locus_pmq_get_file_info(path.c_str(), &info), result);
    return info;
}

} // namespace locus
#endif
