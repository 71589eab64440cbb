// locus/storage.h
#include "capi/boundary.hpp"
#include "capi/pmq_handles.hpp"
#include "core/options.hpp"
#include "pmq/options.hpp"
#include "pmq/storage/recovery.hpp"
#include "pmq/storage/saved_file.hpp"

#include <locus/storage.h>

#include <optional>

using locus::boundary;
using locus::need;
using locus::Progress;
using locus::require;
using namespace locus::pmq;

static_assert(sizeof(locus_pmq_file_info) == 40, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_log_options) == 40, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_recovery) == 80, "append only; then update the ABI baseline");
static_assert(sizeof(locus_pmq_log_stats) == 56, "append only; then update the ABI baseline");

namespace {

constexpr size_t first_info_size = 40, first_log_options_size = 40, first_recovery_size = 80, first_log_stats_size = 56;

locus_pmq_log_options default_log_options() noexcept {
    locus_pmq_log_options options{};
    options.struct_size = sizeof options;
    options.sync = LOCUS_SYNC_BATCH;
    options.redeliver = 1;
    options.sync_interval = 1'000'000;
    options.sync_bytes = 16 << 20;
    options.keep = 1;
    return options;
}

locus_pmq_log_options checked_log_options(const locus_pmq_log_options *options) {
    const locus_pmq_log_options o = locus::read_options(options, default_log_options(), first_log_options_size);
    require(o.sync <= LOCUS_SYNC_INTERVAL, "log_options.sync is ", o.sync, ", not a LOCUS_SYNC_");
    require(o.redeliver <= 1, "log_options.redeliver is ", o.redeliver, ", not 0 or 1");
    require(o.sync_interval >= 0, "log_options.sync_interval is ", o.sync_interval, ", below 0");
    require(o.sync_bytes >= 1, "log_options.sync_bytes is 0");
    require(o.keep <= 100, "log_options.keep is ", o.keep, ", above 100");
    require(o.repair <= 1, "log_options.repair is ", o.repair, ", not 0 or 1");
    return o;
}

// The caller's options of a store, if there are any.
std::optional<locus_pmq_options> read_pmq_options(const locus_pmq_options *options) {
    if (options == nullptr)
        return std::nullopt;
    return locus::read_options(options, default_options(), locus::first_pmq_options_size);
}

const char *checked_path(const char *path, const char *name) {
    require(path != nullptr, name, " is NULL");
    require(path[0] != '\0', name, " is empty");
    return path;
}

const locus_pmq_options *pointer(const std::optional<locus_pmq_options> &options) noexcept {
    return options ? &*options : nullptr;
}

} // namespace

locus_status locus_pmq_save(const locus_pmq *pmq, const locus_pmq_snapshot *snapshot, const char *path,
                            locus_progress_fn progress, void *user) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        checked_path(path, "path");
        require(snapshot == nullptr || snapshot->store == pmq->store, "snapshot is another store's");
        Progress told(progress, user);
        save(snapshot ? *snapshot->moment->view() : *pmq->store->view(), path, told);
    });
}

locus_status locus_pmq_load(const char *path, const locus_pmq_options *options, locus_progress_fn progress, void *user,
                            locus_pmq **pmq) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq") = nullptr;
        checked_path(path, "path");
        const auto whole = read_pmq_options(options);
        Progress told(progress, user);
        *pmq = new locus_pmq{load(path, pointer(whole), told)};
    });
}

locus_status locus_pmq_get_file_info(const char *path, locus_pmq_file_info *info) noexcept {
    return boundary(__func__, [&] {
        checked_path(path, "path");
        need(info, "info");
        const SavedFile file(path);
        locus_pmq_file_info whole{};
        whole.version = file.header().version;
        whole.record = file.header().record;
        whole.records = file.header().records;
        whole.bytes = file.header().bytes;
        whole.now = file.header().now;
        locus::write_report(info, whole, first_info_size, "info");
    });
}

locus_status locus_pmq_log_options_init(locus_pmq_log_options *options, size_t size) noexcept {
    return boundary(__func__,
                    [&] { locus::init_options(options, size, default_log_options(), first_log_options_size); });
}

locus_status locus_pmq_open(const char *folder, const locus_pmq_options *options,
                            const locus_pmq_log_options *log_options, locus_progress_fn progress, void *user,
                            locus_pmq_recovery *recovery, locus_pmq **pmq) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq") = nullptr;
        checked_path(folder, "folder");
        const auto whole = read_pmq_options(options);
        const locus_pmq_log_options log = checked_log_options(log_options);
        locus_pmq_recovery found{};
        if (recovery)
            locus::write_report(recovery, found, first_recovery_size, "recovery");
        Progress told(progress, user);
        auto opened = std::make_unique<locus_pmq>();
        opened->store = open_folder(folder, pointer(whole), log, told, found);
        if (recovery)
            locus::write_report(recovery, found, first_recovery_size, "recovery");
        *pmq = opened.release();
    });
}

locus_status locus_pmq_attach(locus_pmq *pmq, const char *folder, const locus_pmq_log_options *log_options,
                              locus_progress_fn progress, void *user) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        checked_path(folder, "folder");
        const locus_pmq_log_options log = checked_log_options(log_options);
        Progress told(progress, user);
        pmq->store->attach(Folder(folder), log, told);
    });
}

locus_status locus_pmq_checkpoint(locus_pmq *pmq, locus_progress_fn progress, void *user) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        Progress told(progress, user);
        pmq->store->checkpoint(told);
    });
}

locus_status locus_pmq_sync(locus_pmq *pmq) noexcept {
    return boundary(__func__, [&] { need(pmq, "pmq").store->sync(); });
}

locus_status locus_pmq_get_log_stats(const locus_pmq *pmq, locus_pmq_log_stats *stats) noexcept {
    return boundary(__func__, [&] {
        need(pmq, "pmq");
        need(stats, "stats");
        locus::write_report(stats, pmq->store->log_stats(), first_log_stats_size, "stats");
    });
}
