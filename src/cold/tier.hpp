// The tier behind locus_cold: takes records over from a store and answers for both.
#pragma once

#include "cold/answer.hpp"
#include "cold/lock_file.hpp"
#include "cold/writer.hpp"
#include "core/function_ref.hpp"

namespace locus::cold {

class Tier {
public:
    Tier(const std::string &path, const locus_cold_options &options);

    void attach(locus_pmq_options &options);
    uint64_t count(const locus_pmq *pmq, const locus_pmq_query *query);
    // Until `use` says false; false if it did.
    bool visit(const locus_pmq *pmq, const locus_pmq_query *query, FunctionRef<bool(const std::byte *)> use);
    void flush() { writer_.flush(); }
    void sweep(int64_t now) { writer_.set_clock(now); }
    void rewind(uint64_t number);
    locus_cold_stats stats() const;
    void check();
    size_t record_size() const noexcept { return format_.size; }

private:
    class Merge;
    void check_asked(const locus_pmq *pmq, const Question &question) const;
    std::unique_ptr<Answer> answer(const Question &question, uint64_t limit);
    std::unique_ptr<Answer> answer_behind(const Question &question, uint64_t left);
    void await(uint64_t limit) const;
    void check_run(Reader &reader, const Run &run) const;

    const locus_cold_options options_;
    const RecordFormat format_;
    const std::string path_;
    LockFile lock_;
    Database database_; // the writer's connection
    Queue queue_;
    Readers readers_;
    std::atomic<bool> attached_ = false;
    uint64_t base_ = 0; // the number of the attached store's first record
    Writer writer_;
};

} // namespace locus::cold
