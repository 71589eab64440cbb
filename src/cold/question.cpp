#include "cold/question.hpp"

namespace locus::cold {
namespace {

constexpr size_t most_ranges = 128; // more cost more to look up than they spare

locus_pmq_query default_query() {
    locus_pmq_query query;
    ask(locus_pmq_query_init(&query, sizeof query));
    return query;
}

} // namespace

Question::Question(const locus_pmq_query *query, const RecordFormat &format)
    : query_(read_options(query, default_query(), sizeof(locus_pmq_query))), ranges_(most_ranges) {
    locus_pmq_selection *selection = nullptr;
    ask(locus_pmq_selection_create(query, static_cast<uint32_t>(format.size), &selection));
    selection_.reset(selection);
    size_t count = 0;
    ask(locus_pmq_selection_ranges(selection, ranges_.data(), ranges_.size(), &count));
    ranges_.resize(count);
}

locus_pmq_query Question::of_store(uint64_t *left) const noexcept {
    locus_pmq_query query = query_;
    query.expired = 1;
    query.order = LOCUS_ORDER_KEY; // to be merged
    query.left = left;
    return query;
}

bool Question::matches(const std::byte *record, bool inside) const {
    int32_t matches = 0;
    ask(locus_pmq_selection_matches(selection_.get(), record, inside, &matches));
    return matches != 0;
}

} // namespace locus::cold
