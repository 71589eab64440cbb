// Inserting beside the readers.
#include "explorer/live.hpp"

#include "explorer/selection.hpp"

#include <locus/storage.h>

#include <algorithm>
#include <utility>

namespace explorer {
namespace {

constexpr size_t most_queued = 64;       // batches,
constexpr size_t most_waiting = 500'000; // and records
constexpr auto tick = std::chrono::milliseconds(50);
constexpr auto publication = std::chrono::milliseconds(200);
constexpr int64_t rate_seconds = 5;

int64_t second_now() {
    return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

} // namespace

int64_t wall_clock() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(since).count();
}

Live::Live(const LiveSettings &settings) : settings_(settings), stream_clock_(settings.horizon) {
    store_.reset(make(settings));
    settings_.watch(store_.get());
    if (!settings.folder.empty())
        keeper_ = std::make_unique<Keeper>(store_.get(), older_.get(), changing_, settings.save_seconds);
    writer_ = std::thread([this] { run(); });
}

locus_pmq *Live::make(const LiveSettings &settings) {
    locus_pmq_options options;
    check(locus_pmq_options_init(&options, sizeof options));
    options.record = LOCUS_RECORD_TEXT156;
    options.future = LOCUS_FUTURE_CLAMP;
    options.horizon = settings.horizon;
    options.max_bytes = settings.max_bytes;
    locus_pmq *store = nullptr;
    if (settings.folder.empty()) {
        check(locus_pmq_create(&options, &store));
        return store;
    }
    // A batch that was acknowledged outlives the process; the last second of them need not outlive a loss of power.
    locus_pmq_log_options log;
    check(locus_pmq_log_options_init(&log, sizeof log));
    log.sync = LOCUS_SYNC_INTERVAL;
    locus_pmq_recovery recovery{};
    recovery.struct_size = sizeof recovery;
    if (settings.older) {
        older_ = std::make_unique<Older>(*settings.older);
        older_->listen(options);
    }
    check(locus_pmq_open(settings.folder.c_str(), &options, &log, nullptr, nullptr, &recovery, &store));
    std::unique_ptr<locus_pmq, Destroy> opened(store);
    if (older_)
        older_->join(settings.folder, recovery, store);
    recovered_ = recovery.now;
    now_.store(recovery.now);
    if (recovery.records > 0)
        first_.store(INT64_MIN);
    return opened.release();
}

Live::~Live() { stop(); }

void Live::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    more_.notify_all();
    room_.notify_all();
    if (writer_.joinable())
        writer_.join();
    if (keeper_)
        keeper_->stop();
}

std::string Live::keeping() const { return keeper_ ? keeper_->failure() : ""; }

bool Live::enqueue(Job job, bool wait) {
    std::unique_lock lock(mutex_);
    const auto ready = [&] {
        return (queue_.size() < most_queued && waiting_ < most_waiting) || stopping_ || !failure_.empty();
    };
    if (wait)
        room_.wait(lock, ready);
    if (!ready() || stopping_ || !failure_.empty())
        return false;
    waiting_ += job.batch.size();
    queue_.push_back(std::move(job));
    more_.notify_one();
    return true;
}

bool Live::offer(Batch batch) { return enqueue({std::move(batch), nullptr}, true); }

void Live::ingest(Batch batch) {
    auto stored = std::make_shared<std::promise<std::string>>();
    auto result = stored->get_future();
    if (!enqueue({std::move(batch), stored}, false))
        throw Failure(503, failure().empty() ? "ingest: too many batches are waiting" : failure());
    const std::string reason = result.get();
    if (!reason.empty())
        throw Failure(503, reason);
}

void Live::run() {
    for (;;) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, tick, [&] { return !queue_.empty() || stopping_; });
            if (queue_.empty() && stopping_)
                break;
            if (!queue_.empty()) {
                job = std::move(queue_.front());
                queue_.pop_front();
                waiting_ -= job.batch.size();
            }
        }
        room_.notify_all();
        store(job);
    }
}

// Without a batch the clock goes on all the same, and what is expired leaves. Whoever waits for his batch gets a new
// version, so that what is asked after the answer is not taken from before it.
void Live::store(Job &job) {
    std::string reason;
    try {
        reason = insert(job.batch);
        if (job.stored || Clock::now() - published_ >= publication)
            publish();
    } catch (const std::exception &error) {
        reason = error.what();
        const std::lock_guard lock(mutex_);
        failure_ = reason;
        room_.notify_all();
    }
    if (!reason.empty())
        refused_.fetch_add(1, std::memory_order_relaxed);
    if (job.stored)
        job.stored->set_value(reason);
}

std::string Live::insert(const Batch &batch) {
    int64_t now = settings_.clock();
    if (now == INT64_MIN)
        now = stream_clock_.advance(batch);
    now = std::max(now, now_.load(std::memory_order_relaxed));
    if (now == INT64_MIN)
        return "";
    const auto begin = Clock::now();
    const auto cpu = thread_time();
    const locus_status status = change(batch, now);
    // What the store did not take, as it is; the next batch is tried as usual.
    if (status == LOCUS_E_MEMORY || status == LOCUS_E_ARGUMENT || status == LOCUS_E_IO || status == LOCUS_E_STATE)
        return locus_last_error();
    // Stopped: the batch is stored, but what left the window waits, because the database cannot be written.
    if (status != LOCUS_E_STOPPED || !older_)
        check(status);
    now_.store(now, std::memory_order_release);
    if (older_)
        older_->advance(now);
    if (batch.empty())
        return "";
    cpu_.add(static_cast<uint64_t>((thread_time() - cpu).count()));
    wall_.add(static_cast<uint64_t>(std::chrono::nanoseconds(Clock::now() - begin).count()));
    count(batch.size());
    int64_t first = first_.load(std::memory_order_relaxed);
    for (const locus_text156 &record : batch)
        first = std::min(first, int64_t{record.time});
    first_.store(first, std::memory_order_relaxed);
    changed_ = true;
    return "";
}

locus_status Live::change(const Batch &batch, int64_t now) {
    const std::lock_guard lock(changing_);
    return locus_pmq_insert(store_.get(), batch.data(), batch.size(), now);
}

void Live::count(size_t records) {
    const int64_t number = second_now();
    const std::lock_guard lock(mutex_);
    Second &second = seconds_[static_cast<size_t>(number) % seconds_.size()];
    if (second.number != number)
        second = {number, 0};
    second.records += records;
}

double Live::rate() const {
    const int64_t number = second_now();
    uint64_t records = 0;
    const std::lock_guard lock(mutex_);
    for (const Second &second : seconds_)
        if (second.number < number && second.number >= number - rate_seconds)
            records += second.records;
    return static_cast<double>(records) / static_cast<double>(rate_seconds);
}

size_t Live::queued() const {
    const std::lock_guard lock(mutex_);
    return queue_.size();
}

std::string Live::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

// A new version, where the store has changed since the last one: by a batch, or by records that have left.
void Live::publish() {
    published_ = Clock::now();
    if (!changed_ && !shrunk())
        return;
    changed_ = false;
    version_.fetch_add(1, std::memory_order_release);
}

// Whether records have left since this was last asked. Large stores take long to tell, and are asked less often.
bool Live::shrunk() {
    if (!counting_.due())
        return false;
    const uint64_t gone = counting_.spend([this] {
        locus_pmq_stats stats{};
        stats.struct_size = sizeof stats;
        check(locus_pmq_get_stats(store_.get(), &stats));
        return stats.inserted - stats.records;
    });
    return std::exchange(gone_, gone) != gone;
}

} // namespace explorer
