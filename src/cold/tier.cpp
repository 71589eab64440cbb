// Store and tier at one moment. The store tells with its answer how many records had left it: those are the tier's, and
// what came after them was still in the store.
#include "cold/tier.hpp"

#include <exception>
#include <thread>

namespace locus::cold {
namespace {

int32_t take_over(const void *record, void *queue) {
    return static_cast<Queue *>(queue)->put(static_cast<const std::byte *>(record)) ? 0 : 1;
}

// Open a file and see that it is a tier's.
Database prepared(const std::string &path, const locus_cold_options &options) {
    Database database(path, Database::Mode::write, options.cache_bytes);
    prepare(database, path, options.record);
    return database;
}

} // namespace

Tier::Tier(const std::string &path, const locus_cold_options &options)
    : options_(options), format_{options.record}, path_(path), lock_(path + "-lock"),
      database_(prepared(path, options)),
      queue_(format_.size, options.queue_bytes, options.when_full == LOCUS_COLD_FULL_WAIT, options.batch_records,
             std::chrono::microseconds(options.delay)),
      readers_(path), writer_(database_, options_, format_, queue_) {}

void Tier::attach(locus_pmq_options &options) {
    require(options.record == options_.record, "options->record is ", options.record, ", the tier's is ",
            options_.record);
    require(options.sink == nullptr, "options->sink is set");
    options.sink = take_over;
    options.sink_user = &queue_;
    base_ = queue_.received();
    attached_ = true;
}

// Records that have left the store and not come yet are on their way, unless the sink refused.
void Tier::await(uint64_t limit) const {
    using namespace std::chrono;
    const auto waits = [&](uint64_t received) {
        fail(LOCUS_E_STATE, limit - received, " records that left the store wait in it for the tier: sweep it");
    };
    uint64_t received = queue_.received();
    for (auto since = steady_clock::now(); received < limit;) {
        if (queue_.refused())
            waits(received);
        std::this_thread::sleep_for(microseconds(50));
        const uint64_t before = std::exchange(received, queue_.received());
        if (received != before || queue_.waiting())
            since = steady_clock::now();
        else if (steady_clock::now() - since > seconds(10))
            waits(received);
    }
}

std::unique_ptr<Answer> Tier::answer(const Question &question, uint64_t limit) {
    await(limit);
    const int64_t cutoff = writer_.cutoff();
    return std::make_unique<Answer>(readers_, queue_.content(), format_, question, limit, cutoff, options_.max_age);
}

std::unique_ptr<Answer> Tier::answer_behind(const Question &question, uint64_t left) {
    if (question.left())
        *question.left() = left;
    return answer(question, base_ + left);
}

void Tier::check_asked(const locus_pmq *pmq, const Question &question) const {
    require(pmq != nullptr || !question.has_snapshot(), "query.snapshot is set, pmq is NULL");
    if (pmq != nullptr && !attached_)
        fail(LOCUS_E_STATE, "pmq is a store, but none is attached");
}

uint64_t Tier::count(const locus_pmq *pmq, const locus_pmq_query *query) {
    const Question question(query, format_);
    check_asked(pmq, question);
    if (pmq == nullptr)
        return answer(question, queue_.received())->count();
    uint64_t left = 0, live = 0;
    const locus_pmq_query of_store = question.of_store(&left);
    ask(locus_pmq_count(pmq, &of_store, &live));
    return live + answer_behind(question, left)->count();
}

// The store shows its records in order; before each one come those of the tier.
class Tier::Merge {
public:
    Merge(Tier &tier, const Question &question, FunctionRef<bool(const std::byte *)> use)
        : tier_(tier), question_(question), use_(use) {}

    bool run(const locus_pmq *pmq) {
        const locus_pmq_query of_store = question_.of_store(&left_);
        const locus_status status = locus_pmq_visit(pmq, &of_store, show, this);
        if (failure_)
            std::rethrow_exception(failure_);
        if (stopped_)
            return false;
        ask(status);
        open();
        return up_to(UINT64_MAX);
    }

private:
    static int32_t show(const void *record, void *user) {
        return static_cast<Merge *>(user)->show(static_cast<const std::byte *>(record)) ? 0 : 1;
    }

    bool show(const std::byte *record) {
        try {
            open();
            stopped_ = !(answer_->ended() || up_to(tier_.format_.key(record))) || !use_(record);
        } catch (...) {
            failure_ = std::current_exception();
        }
        return !stopped_ && !failure_;
    }

    void open() {
        if (answer_)
            return;
        answer_ = tier_.answer_behind(question_, left_);
        answer_->start();
    }

    bool up_to(uint64_t key) {
        for (; !answer_->ended() && answer_->key() <= key; answer_->next())
            if (!use_(answer_->record()))
                return false;
        return true;
    }

    Tier &tier_;
    const Question &question_;
    FunctionRef<bool(const std::byte *)> use_;
    uint64_t left_ = 0;
    std::unique_ptr<Answer> answer_;
    std::exception_ptr failure_;
    bool stopped_ = false;
};

bool Tier::visit(const locus_pmq *pmq, const locus_pmq_query *query, FunctionRef<bool(const std::byte *)> use) {
    const Question question(query, format_);
    check_asked(pmq, question);
    if (pmq != nullptr)
        return Merge(*this, question, use).run(pmq);
    const auto found = answer(question, queue_.received());
    for (found->start(); !found->ended(); found->next())
        if (!use(found->record()))
            return false;
    return true;
}

void Tier::rewind(uint64_t number) {
    if (attached_)
        fail(LOCUS_E_STATE, "a store is attached");
    writer_.flush();
    writer_.rewind(number);
}

locus_cold_stats Tier::stats() const {
    locus_cold_stats stats{};
    writer_.report(stats);
    stats.struct_size = sizeof stats;
    const Queue::Content content = queue_.content();
    stats.received = content.received;
    stats.written = content.written;
    stats.queue_bytes = queue_.bytes();
    stats.waits = queue_.waits();
    return stats;
}

void Tier::check() {
    const Readers::Loan reader(readers_);
    Database &file = (*reader).database;
    Transaction transaction(file, Transaction::Kind::read);
    Statement integrity = file.prepare("PRAGMA integrity_check(1)");
    if (integrity.step() && integrity.text(0) != "ok")
        fail(LOCUS_E_FORMAT, path_, ": ", integrity.text(0));
    integrity.reset();
    for (const Run &run : read_runs(file))
        check_run(*reader, run);
}

void Tier::check_run(Reader &reader, const Run &run) const {
    const auto hold = [&](bool good, const auto &...parts) {
        if (!good)
            fail(LOCUS_E_FORMAT, path_, ": ", run.table(), ": ", parts...);
    };
    Statement rows = reader.database.prepare("SELECT key, arrival, record FROM " + run.table());
    uint64_t records = 0;
    while (rows.step()) {
        const auto key = static_cast<uint64_t>(rows.number(0)), arrival = static_cast<uint64_t>(rows.number(1));
        const std::byte *record = rows.bytes(2, format_.size);
        hold(record != nullptr, "the record ", arrival, " has not ", format_.size, " bytes");
        hold(format_.key(record) == key, "the record ", arrival, " has the key ", format_.key(record), ", not ", key);
        hold(key >= run.lowest && key <= run.highest, "the key ", key, " is not within ", run.lowest, "..",
             run.highest);
        hold(arrival < run.end - run.first, "the record ", arrival, " lies behind the end, ", run.end - run.first);
        const int64_t time = format_.time(record);
        hold(time >= run.oldest && time <= run.youngest, "the time ", time, " is not within ", run.oldest, "..",
             run.youngest);
        ++records;
    }
    hold(records == run.records, records, " records, not ", run.records);
}

} // namespace locus::cold
