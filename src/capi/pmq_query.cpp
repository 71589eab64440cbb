// Reading a caller's query.
#include "capi/pmq_handles.hpp"
#include "core/options.hpp"
#include "pmq/query/circle.hpp"
#include "pmq/query/polygon.hpp"

namespace locus {

using namespace pmq;

locus_pmq_query default_query() noexcept {
    locus_pmq_query query{};
    query.struct_size = sizeof query;
    query.region = LOCUS_REGION_ALL;
    query.time_from = INT64_MIN;
    query.time_to = INT64_MAX;
    return query;
}

namespace {

std::unique_ptr<const Region> region_of(const locus_pmq_query &query) {
    switch (query.region) {
    case LOCUS_REGION_ALL:
        return nullptr;
    case LOCUS_REGION_BOX:
        return std::make_unique<BoxRegion>(query.box);
    case LOCUS_REGION_CIRCLE:
        return std::make_unique<CircleRegion>(query.circle);
    case LOCUS_REGION_POLYGON:
        return std::make_unique<PolygonRegion>(query.polygon);
    default:
        fail(LOCUS_E_ARGUMENT, "query.region is ", query.region, ", not a LOCUS_REGION_");
    }
}

} // namespace

Question::Question(const locus_pmq_query *query) {
    const locus_pmq_query whole = read_options(query, default_query(), first_query_size);
    require(whole.expired <= 1, "query.expired is ", whole.expired, ", not 0 or 1");
    require(whole.time_from <= whole.time_to, "query.time_from is ", whole.time_from, ", after time_to, ",
            whole.time_to);
    require(whole.order <= LOCUS_ORDER_ANY, "query.order is ", whole.order, ", not a LOCUS_ORDER_");
    require(whole.reserved0 == 0, "query.reserved0 is ", whole.reserved0, ", not 0");
    region_ = region_of(whole);
    selection_.region = region_.get();
    selection_.times = {whole.time_from, whole.time_to};
    selection_.filter = whole.filter;
    selection_.filter_user = whole.filter_user;
    selection_.expired = whole.expired == 1;
    order_ = whole.order == LOCUS_ORDER_ANY ? Order::any : Order::key;
    snapshot_ = whole.snapshot;
    left_ = whole.left;
}

std::shared_ptr<const View> Question::view(const locus_pmq &pmq) const {
    if (snapshot_ != nullptr)
        require(snapshot_->store == pmq.store, "query.snapshot is another store's");
    auto view = snapshot_ == nullptr ? pmq.store->view() : snapshot_->moment->view();
    if (left_ != nullptr)
        *left_ = pmq.store->left(*view);
    return view;
}

} // namespace locus
