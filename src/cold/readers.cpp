#include "cold/readers.hpp"

namespace locus::cold {
namespace {

constexpr uint64_t cache_bytes = 8 << 20;
constexpr size_t most_statements = 512; // beyond, those of all runs are made anew

} // namespace

Reader::Reader(const std::string &path) : database(path, Database::Mode::read, cache_bytes) {}

Reader::Statements &Reader::of(const Run &run) {
    if (const auto at = statements_.find(run.first); at != statements_.end())
        return at->second;
    const std::string from = " FROM " + run.table() + " WHERE key >= ?1";
    Statements made{database.prepare("SELECT key, arrival, record" + from + " ORDER BY key, arrival"),
                    database.prepare("SELECT count(*)" + from + " AND key <= ?2")};
    return statements_.emplace(run.first, std::move(made)).first->second;
}

Statement &Reader::rows(const Run &run) { return of(run).rows; }

Statement &Reader::count(const Run &run) { return of(run).count; }

void Reader::forget_statements() {
    if (statements_.size() > most_statements)
        statements_.clear();
}

Readers::Loan::Loan(Readers &from) : from_(from) {
    {
        const std::lock_guard lock(from.mutex_);
        from.idle_.reserve(from.idle_.size() + 1 + from.lent_);
        ++from.lent_;
        if (!from.idle_.empty()) {
            reader_ = std::move(from.idle_.back());
            from.idle_.pop_back();
        }
    }
    if (reader_)
        return;
    try {
        reader_ = std::make_unique<Reader>(from.path_);
    } catch (...) {
        const std::lock_guard lock(from.mutex_);
        --from.lent_;
        throw;
    }
}

Readers::Loan::~Loan() {
    reader_->forget_statements();
    const std::lock_guard lock(from_.mutex_);
    --from_.lent_;
    from_.idle_.push_back(std::move(reader_)); // reserved
}

} // namespace locus::cold
