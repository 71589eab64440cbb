// What has left the window: the cold tier of locus/cold.h, FOLDER/older.db, beside the store's own files.
//
// After an end of any kind the store hands over again what left since its saved file, of which the tier may have kept
// none, some or all. So each saved file has a mark that tells how far the tier was at its moment: the tier forgets what
// came later, and gets it again.
#pragma once

#include "explorer/marks.hpp"

#include <locus/cold.h>
#include <locus/storage.h>

#include <memory>

namespace explorer {

struct OlderSettings {
    int64_t max_age = 0;    // microseconds, of a record's time
    uint64_t max_bytes = 0; // of the file, or LOCUS_NO_LIMIT
};

class Older {
public:
    explicit Older(const OlderSettings &settings) : settings_(settings) {}
    Older(const Older &) = delete; // the store's options point here
    Older &operator=(const Older &) = delete;

    // First the options of a store that is to be opened, then the store that was: what it has to hand over again comes
    // at once. Throws a Failure or std::runtime_error.
    void listen(locus_pmq_options &options);
    void join(const std::string &folder, const locus_pmq_recovery &recovery, locus_pmq *store);

    // The clock of what is too old. The writer calls it.
    void advance(int64_t now);

    // Of a saved file: `received` tells, between two changes of the store, how far the tier is. `mark` has it on the
    // disk with all records up to there, and goes before the file; `saved` comes after it. Throw as join does.
    uint64_t received() const { return stats().received; }
    void mark(uint64_t number, uint64_t received);
    void saved(uint64_t number);

    locus_cold *tier() const { return tier_.get(); }
    locus_cold_stats stats() const;

private:
    struct Close {
        void operator()(locus_cold *tier) const { locus_cold_close(tier); }
    };

    void open(const std::string &folder);
    void rewind(uint64_t number);
    static int32_t take(const void *record, void *user);

    OlderSettings settings_;
    std::unique_ptr<locus_cold, Close> tier_;
    std::unique_ptr<Marks> marks_;
    locus_sink_fn sink_ = nullptr; // the tier's
    void *sink_user_ = nullptr;
    uint64_t latest_ = 0, least_ = 0; // saved file, and the earliest whose mark may be needed
    int64_t clock_ = INT64_MIN;
};

} // namespace explorer
