// Connections that read the file, each used by one query at a time and kept for the next.
#pragma once

#include "cold/schema.hpp"

#include <map>
#include <memory>
#include <mutex>

namespace locus::cold {

class Reader {
public:
    explicit Reader(const std::string &path);
    // Rows of a run from a key on, in order: key, arrival, record; and how many there are from one key to another.
    Statement &rows(const Run &run);
    Statement &count(const Run &run);
    void forget_statements(); // if there are many: none must be in use
    Database database;

private:
    struct Statements {
        Statement rows, count;
    };
    Statements &of(const Run &run);
    std::map<uint64_t, Statements> statements_;
};

class Readers {
public:
    explicit Readers(std::string path) : path_(std::move(path)) {}

    // A reader on loan.
    class Loan {
    public:
        explicit Loan(Readers &from);
        ~Loan();
        Loan(const Loan &) = delete;
        Loan &operator=(const Loan &) = delete;
        Reader &operator*() const noexcept { return *reader_; }

    private:
        Readers &from_;
        std::unique_ptr<Reader> reader_;
    };

private:
    const std::string path_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Reader>> idle_;
    size_t lent_ = 0;
};

} // namespace locus::cold
