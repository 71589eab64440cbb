// What the file holds: the runs and the tier's own figures, made, checked and read.
#pragma once

#include "cold/database.hpp"

#include <vector>

namespace locus::cold {

// Consecutive records, some of which retention may have taken out. In the table `runs`.
struct Run {
    uint64_t first = 0, end = 0; // numbers of records: all lie in first..end - 1
    uint64_t records = 0;
    int64_t oldest = INT64_MAX, youngest = INT64_MIN;
    uint64_t lowest = UINT64_MAX, highest = 0; // keys
    int64_t cleared = INT64_MIN;               // no record is older than this

    std::string table() const { return "run_" + std::to_string(first); }
};

struct State {
    uint64_t written = 0, removed = 0;
    int64_t now = INT64_MIN;
};

// Records with a time before the result are too old.
int64_t cutoff_at(int64_t now, int64_t max_age) noexcept;

// Make the tables in an empty file, or see that they are this tier's. Throws Error, and then nothing has changed.
void prepare(Database &database, const std::string &path, uint32_t record);

State read_state(const Database &database);
void write_state(Database &database, const State &state);
std::vector<Run> read_runs(const Database &database); // in their order
void create_run(Database &database, const Run &run);
void write_run(Database &database, const Run &run);
void drop_run(Database &database, const Run &run);

} // namespace locus::cold
