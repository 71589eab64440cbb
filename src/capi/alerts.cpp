// locus/alerts.h
#include "pmq/alerts/alerts.hpp"
#include "capi/boundary.hpp"
#include "capi/pmq_handles.hpp"
#include "core/options.hpp"

using locus::boundary;
using locus::need;
using locus::Question;
using locus::require;
using namespace locus::pmq;

struct locus_alerts {
    std::shared_ptr<Alerts> alerts; // the store holds it, too
};

static_assert(sizeof(locus_alert) == 96, "its layout never changes");
static_assert(sizeof(locus_alerts_options) == 112, "append only; then update the ABI baseline");
static_assert(sizeof(locus_alerts_stats) == 48, "append only; then update the ABI baseline");

namespace {

constexpr size_t first_options_size = 112, first_stats_size = 48;

} // namespace

locus_status locus_alerts_options_init(locus_alerts_options *options, size_t size) noexcept {
    return boundary(__func__,
                    [&] { locus::init_options(options, size, default_alerts_options(), first_options_size); });
}

locus_status locus_alerts_create(locus_pmq *pmq, const locus_alerts_options *options, locus_alerts **alerts) noexcept {
    return boundary(__func__, [&] {
        need(alerts, "alerts") = nullptr;
        need(pmq, "pmq");
        auto made = std::make_unique<locus_alerts>();
        made->alerts =
            std::make_shared<Alerts>(locus::read_options(options, default_alerts_options(), first_options_size));
        pmq->store->observe(made->alerts);
        *alerts = made.release();
    });
}

void locus_alerts_destroy(locus_alerts *alerts) noexcept {
    if (alerts == nullptr)
        return;
    alerts->alerts->end();
    delete alerts;
}

locus_status locus_alerts_active(const locus_alerts *alerts, locus_alert *active, size_t capacity,
                                 size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(alerts, "alerts");
        need(count, "count");
        require(active != nullptr || capacity == 0, "active is NULL, capacity is ", capacity);
        *count = alerts->alerts->active(active, capacity);
        if (*count > capacity)
            locus::fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", there are ", *count, " active alerts");
    });
}

locus_status locus_alerts_add_fence(locus_alerts *alerts, uint64_t id, const locus_pmq_query *query) noexcept {
    return boundary(__func__, [&] {
        need(alerts, "alerts");
        Question question(&need(query, "query"));
        require(question.snapshot() == nullptr, "query.snapshot is set: fences are of what comes");
        const Selection selection = question.selection();
        alerts->alerts->add_fence(id, question.take_region(), selection);
    });
}

locus_status locus_alerts_remove_fence(locus_alerts *alerts, uint64_t id) noexcept {
    return boundary(__func__, [&] { need(alerts, "alerts").alerts->remove_fence(id); });
}

locus_status locus_alerts_get_stats(const locus_alerts *alerts, locus_alerts_stats *stats) noexcept {
    return boundary(__func__, [&] {
        need(alerts, "alerts");
        need(stats, "stats");
        locus::write_report(stats, alerts->alerts->stats(), first_stats_size, "stats");
    });
}
