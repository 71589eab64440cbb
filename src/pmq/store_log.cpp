// The store and its log.
#include "core/error.hpp"
#include "pmq/storage/saved_file.hpp"
#include "pmq/store.hpp"

namespace locus::pmq {
namespace {

// One checkpoint at a time.
class Saving {
public:
    explicit Saving(std::atomic<bool> &busy) : busy_(busy) {
        if (busy_.exchange(true))
            fail(LOCUS_E_BUSY, "another checkpoint is at work");
    }
    ~Saving() { busy_.store(false); }
    Saving(const Saving &) = delete;
    Saving &operator=(const Saving &) = delete;

private:
    std::atomic<bool> &busy_;
};

} // namespace

void Store::attach(Folder &&folder, const locus_pmq_log_options &options, Progress &progress) {
    const Standing standing(*this);
    if (journal_)
        fail(LOCUS_E_STATE, "the store has a folder already: ", journal_->folder().path());
    if (!folder.content().empty())
        fail(LOCUS_E_STATE, folder.path(), ": the folder holds a store already: see locus_pmq_open");
    folder.tidy(0);
    start_log(std::move(folder), options, {1, 0, 1}, progress);
}

void Store::start_log(Folder &&folder, const locus_pmq_log_options &options, const Journal::Position &position,
                      Progress &progress) {
    const std::shared_ptr<const View> moment = layout_->view();
    const std::string path = folder.saved(position.number), log = folder.log(position.number);
    save(*moment, path, progress);
    try {
        auto journal = std::make_unique<Journal>(std::move(folder), format_, options, position);
        journal->carry(moment->moment(), departures_.waiting());
        journal_ = std::move(journal);
    } catch (...) {
        ::unlink(log.c_str());
        ::unlink(path.c_str());
        throw;
    }
}

void Store::checkpoint(Progress &progress) {
    const Saving saving(saving_);
    std::shared_ptr<const View> moment;
    std::string path;
    {
        const Standing standing(*this);
        if (!journal_)
            fail(LOCUS_E_STATE, "the store has no folder");
        moment = view();
        path = journal_->folder().saved(journal_->rotate(moment->moment(), departures_.waiting()));
    }
    save(*moment, path, progress);
    moment.reset();
    const Standing standing(*this);
    journal_->saved();
}

void Store::sync() {
    const Standing standing(*this);
    if (!journal_)
        fail(LOCUS_E_STATE, "the store has no folder");
    journal_->sync();
}

locus_pmq_log_stats Store::log_stats() const {
    locus_pmq_log_stats none{};
    none.struct_size = sizeof none;
    const Standing standing(*this);
    return journal_ ? journal_->stats() : none;
}

} // namespace locus::pmq
