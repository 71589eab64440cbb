// The tier's part of an answer: what queue and file hold at one moment of the records that a question selects.
#pragma once

#include "cold/question.hpp"
#include "cold/queue.hpp"
#include "cold/readers.hpp"

#include <optional>

namespace locus::cold {

class Answer {
public:
    // Of the records with numbers below `limit` that are not older than `cutoff`. `content` must have been taken from
    // the queue when all those had been received.
    Answer(Readers &readers, Queue::Content content, const RecordFormat &format, const Question &question,
           uint64_t limit, int64_t cutoff, int64_t max_age);
    ~Answer();
    Answer(const Answer &) = delete;
    Answer &operator=(const Answer &) = delete;

    uint64_t count();

    // The records one after the other, in the order (key, arrival).
    bool ended() const noexcept { return order_.empty(); }
    uint64_t key() const noexcept { return order_.front()->at.key; }
    const std::byte *record() const noexcept { return order_.front()->record; }
    void start();
    void next();

private:
    // A sequence of selected records in order; a run's rows, or the queue's records.
    struct Source {
        Entry at{};
        const std::byte *record = nullptr;
        Run run;
        Statement *rows = nullptr; // nullptr: the queue's
        size_t range = 0;          // of the question's, where the rows are
        size_t entry = 0;          // in `queued_`
    };
    bool advance(Source &source);
    bool advance_rows(Source &source);
    bool accepts(const std::byte *record, const Run &run, bool inside) const;
    bool concerns(const Run &run) const noexcept;
    bool plain(const Run &run) const noexcept;
    uint64_t count_run(const Run &run);
    void collect_queued();
    void collect(const locus_key_range &range);
    bool is_queued(uint64_t number) const noexcept { return number >= written_ && number < limit_; }

    const RecordFormat format_;
    const Question &question_;
    const Queue::Content content_;
    Readers::Loan reader_;
    std::optional<Transaction> transaction_; // the file's moment
    uint64_t limit_;
    int64_t cutoff_;
    uint64_t written_ = 0;
    std::vector<Run> runs_;
    std::vector<Entry> queued_; // selected ones, in order
    std::vector<Source> sources_;
    std::vector<Source *> order_; // a heap, the least in front
};

} // namespace locus::cold
