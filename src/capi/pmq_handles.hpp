// The bodies of the PMQ's handles, and a caller's query as the engine understands it.
#pragma once

#include "core/error.hpp"
#include "pmq/store.hpp"

#include <memory>

struct locus_pmq {
    std::shared_ptr<locus::pmq::Store> store;
};

struct locus_pmq_snapshot {
    std::shared_ptr<locus::pmq::Store> store; // kept alive
    std::shared_ptr<const locus::pmq::Snapshot> moment;
};

namespace locus {

constexpr size_t first_pmq_options_size = 144; // of locus_pmq_options, in the release that introduced it
constexpr size_t first_query_size = 136;
locus_pmq_query default_query() noexcept;

// A query and the region it asks for.
class Question {
public:
    explicit Question(const locus_pmq_query *query);
    Question(const Question &) = delete;
    Question &operator=(const Question &) = delete;
    const pmq::Selection &selection() const noexcept { return selection_; }
    pmq::Order order() const noexcept { return order_; }
    const locus_pmq_snapshot *snapshot() const noexcept { return snapshot_; }
    // What is to be asked; tells the caller how many records had left by then.
    std::shared_ptr<const pmq::View> view(const locus_pmq &pmq) const;
    // The selection's region, which then lives as long as the caller wants.
    std::unique_ptr<const pmq::Region> take_region() noexcept { return std::move(region_); }

private:
    std::unique_ptr<const pmq::Region> region_;
    pmq::Selection selection_;
    pmq::Order order_ = pmq::Order::key;
    const locus_pmq_snapshot *snapshot_ = nullptr;
    uint64_t *left_ = nullptr; // where the number of records that had left goes
};

} // namespace locus
