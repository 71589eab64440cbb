// Queue and file, searched by key ranges and merged.
#include "cold/answer.hpp"

#include <algorithm>

namespace locus::cold {
namespace {

constexpr auto later = [](const auto *a, const auto *b) noexcept { return b->at < a->at; };

} // namespace

// What leaves the queue enters the file: the queue was looked at first, so that nothing is in neither; and what is in
// both is taken from the file, which says how far it goes.
Answer::Answer(Readers &readers, Queue::Content content, const RecordFormat &format, const Question &question,
               uint64_t limit, int64_t cutoff, int64_t max_age)
    : format_(format), question_(question), content_(std::move(content)), reader_(readers), limit_(limit) {
    Database &file = (*reader_).database;
    transaction_.emplace(file, Transaction::Kind::read);
    const State state = read_state(file);
    written_ = state.written;
    cutoff_ = std::max(cutoff, cutoff_at(state.now, max_age));
    for (const Run &run : read_runs(file))
        if (concerns(run))
            runs_.push_back(run);
    collect_queued();
}

Answer::~Answer() {
    for (const Source &source : sources_)
        if (source.rows)
            source.rows->reset();
}

bool Answer::concerns(const Run &run) const noexcept {
    const auto &ranges = question_.ranges();
    return run.first < limit_ && run.youngest >= std::max(cutoff_, question_.time_from()) &&
           run.oldest <= question_.time_to() && !ranges.empty() && run.highest >= ranges.front().first &&
           run.lowest <= ranges.back().last;
}

// Only places are left to ask.
bool Answer::plain(const Run &run) const noexcept {
    return run.end <= limit_ && !question_.has_filter() && run.oldest >= std::max(cutoff_, question_.time_from()) &&
           run.youngest <= question_.time_to();
}

void Answer::collect_queued() {
    const uint64_t sorted_end = content_.written + (content_.sorted ? content_.sorted->size() : 0);
    if (written_ < sorted_end)
        for (const locus_key_range &range : question_.ranges())
            collect(range);
    const uint64_t end = std::min(limit_, content_.received);
    for (uint64_t number = std::max(written_, sorted_end); number < end; ++number) {
        const std::byte *record = content_.record(number);
        if (format_.time(record) >= cutoff_ && question_.matches(record, false))
            queued_.push_back({format_.key(record), number});
    }
    std::sort(queued_.begin(), queued_.end());
}

// From the batch at work, which is sorted.
void Answer::collect(const locus_key_range &range) {
    const auto &entries = *content_.sorted;
    for (auto at = std::lower_bound(entries.begin(), entries.end(), Entry{range.first, 0});
         at != entries.end() && at->key <= range.last; ++at) {
        const std::byte *record = content_.record(at->number);
        if (is_queued(at->number) && format_.time(record) >= cutoff_ && question_.matches(record, range.inside != 0))
            queued_.push_back(*at);
    }
}

bool Answer::advance(Source &source) {
    if (source.rows)
        return advance_rows(source);
    if (source.entry == queued_.size())
        return false;
    source.at = queued_[source.entry++];
    source.record = content_.record(source.at.number);
    return true;
}

// Rows lead from range to range: a row beyond the present one tells which may be next.
bool Answer::advance_rows(Source &source) {
    const auto &ranges = question_.ranges();
    while (source.rows->step()) {
        const auto key = static_cast<uint64_t>(source.rows->number(0));
        while (source.range < ranges.size() && ranges[source.range].last < key)
            ++source.range;
        if (source.range == ranges.size())
            break;
        const locus_key_range &range = ranges[source.range];
        if (key < range.first) {
            source.rows->reset();
            source.rows->bind(1, static_cast<int64_t>(range.first));
            continue;
        }
        const std::byte *record = source.rows->bytes(2, format_.size);
        if (record == nullptr)
            fail(LOCUS_E_FORMAT, source.run.table(), ": a record that has not ", format_.size, " bytes");
        source.at = {key, source.run.first + static_cast<uint64_t>(source.rows->number(1))};
        source.record = record;
        if (source.at.number < limit_ && format_.time(record) >= cutoff_ &&
            question_.matches(record, range.inside != 0))
            return true;
    }
    source.rows->reset();
    return false;
}

void Answer::start() {
    sources_.reserve(runs_.size() + 1);
    order_.reserve(runs_.size() + 1);
    sources_.push_back({});
    for (const Run &run : runs_) {
        Source source;
        source.run = run;
        source.rows = &(*reader_).rows(run);
        source.rows->bind(1, static_cast<int64_t>(std::max(run.lowest, question_.ranges().front().first)));
        sources_.push_back(source);
    }
    for (Source &source : sources_) {
        if (!advance(source))
            continue;
        order_.push_back(&source);
        std::push_heap(order_.begin(), order_.end(), later);
    }
}

void Answer::next() {
    std::pop_heap(order_.begin(), order_.end(), later);
    if (advance(*order_.back()))
        std::push_heap(order_.begin(), order_.end(), later);
    else
        order_.pop_back();
}

uint64_t Answer::count() {
    uint64_t total = queued_.size();
    for (const Run &run : runs_)
        total += count_run(run);
    return total;
}

uint64_t Answer::count_run(const Run &run) {
    const auto &ranges = question_.ranges();
    const bool inside = std::all_of(ranges.begin(), ranges.end(), [](const auto &range) { return range.inside != 0; });
    uint64_t total = 0;
    if (!inside || !plain(run)) {
        Source source;
        source.run = run;
        source.rows = &(*reader_).rows(run);
        source.rows->bind(1, static_cast<int64_t>(std::max(run.lowest, ranges.front().first)));
        sources_.assign(1, source); // to be reset in any case
        while (advance(sources_.front()))
            ++total;
        return total;
    }
    for (const locus_key_range &range : ranges) {
        if (range.first <= run.lowest && run.highest <= range.last)
            return run.records;
        Statement &count = (*reader_).count(run);
        count.bind(1, static_cast<int64_t>(range.first)).bind(2, static_cast<int64_t>(range.last)).step();
        total += static_cast<uint64_t>(count.number(0));
        count.reset();
    }
    return total;
}

} // namespace locus::cold
