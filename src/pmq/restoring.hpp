// Making a store from what was saved: first the saved records, in the order (key, arrival), then the batches since.
#pragma once

#include "pmq/store.hpp"

#include <memory>
#include <optional>
#include <span>

namespace locus::pmq {

class Restoring {
public:
    // The store is new; `now` is the clock it will have. Its predicate is not asked, its callbacks are not called.
    // The crew helps to fill it.
    Restoring(Store &store, int64_t now, Crew &crew);

    void add(const Batch &batch); // saved ones
    // Or in parts, by several threads; see Layout.
    bool takes_parts() const noexcept;
    std::unique_ptr<Layout::Parts> begin_parts(std::span<const size_t> sizes);
    void end_parts(Layout::Parts &parts);
    void insert(std::span<const std::byte> records);
    // It has left: hand it over as soon as the store is used.
    void depart(Bytes record);
    void finish(); // horizon and limits hold from now on

    const Moment &moment() const noexcept { return eviction_.moment(); }

private:
    void flush();
    void fill(const Batch &batch);
    void flush_departures();

    Store &store_;
    Crew &crew_;
    const RecordFormat &format_;
    Eviction eviction_;
    std::vector<uint64_t> keys_; // of what has been added
    std::vector<std::byte> records_;
    int64_t oldest_ = INT64_MAX;
    size_t enough_;
    std::optional<Departures::Group> leaving_;
};

} // namespace locus::pmq
