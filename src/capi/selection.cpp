// locus/pmq.h: queries for records that lie outside a store.
#include "capi/boundary.hpp"
#include "capi/pmq_handles.hpp"
#include "pmq/query/cover.hpp"

#include <algorithm>

using locus::boundary;
using locus::need;
using locus::require;

struct locus_pmq_selection {
    locus_pmq_selection(const locus_pmq_query *query, const locus::pmq::RecordFormat &records)
        : question(query), format(records) {}
    const locus::Question question;
    const locus::pmq::RecordFormat &format;
};

static_assert(sizeof(locus_key_range) == 24, "never changes");

locus_status locus_pmq_selection_create(const locus_pmq_query *query, uint32_t record,
                                        locus_pmq_selection **selection) noexcept {
    return boundary(__func__, [&] {
        need(selection, "selection") = nullptr;
        require(record == LOCUS_RECORD_POINT32 || record == LOCUS_RECORD_TEXT156, "record is ", record,
                ", not a LOCUS_RECORD_");
        *selection =
            new locus_pmq_selection(query, record == LOCUS_RECORD_POINT32 ? locus::pmq::point32 : locus::pmq::text156);
    });
}

void locus_pmq_selection_destroy(locus_pmq_selection *selection) noexcept { delete selection; }

locus_status locus_pmq_selection_ranges(const locus_pmq_selection *selection, locus_key_range *ranges, size_t capacity,
                                        size_t *count) noexcept {
    return boundary(__func__, [&] {
        need(selection, "selection");
        need(ranges, "ranges");
        need(count, "count");
        require(capacity > 0, "capacity is 0");
        const auto cover = locus::pmq::cover(selection->question.selection().region, capacity);
        std::copy(cover.begin(), cover.end(), ranges);
        *count = cover.size();
    });
}

locus_status locus_pmq_selection_matches(const locus_pmq_selection *selection, const void *record, uint32_t inside,
                                         int32_t *matches) noexcept {
    return boundary(__func__, [&] {
        const auto &format = need(selection, "selection").format;
        require(record != nullptr, "record is NULL");
        require(inside <= 1, "inside is ", inside, ", not 0 or 1");
        need(matches, "matches");
        const auto bytes = static_cast<locus::pmq::Bytes>(record);
        const locus::pmq::Selection &wanted = selection->question.selection();
        *matches = wanted.times.contains(format.time(bytes)) &&
                   (!wanted.region || inside == 1 ||
                    wanted.region->contains(format.latitude(bytes), format.longitude(bytes))) &&
                   (!wanted.filter || wanted.filter(record, wanted.filter_user) != 0);
    });
}
