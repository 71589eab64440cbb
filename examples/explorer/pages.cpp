// Turning pages.
#include "explorer/pages.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace explorer {
namespace {

constexpr size_t most_passed = 200'000;

// Where a page begins: at the records of one time or of one key, of which some have been shown.
template <typename Value>
struct Bookmark {
    Value value;
    size_t passed = 0;
};

template <typename Value>
Bookmark<Value> bookmark_of(const std::string &text, Value first) {
    Bookmark<Value> mark{first};
    if (text.empty())
        return mark;
    const char *end = text.data() + text.size();
    const auto [colon, wrong] = std::from_chars(text.data(), end, mark.value);
    if (wrong == std::errc() && colon != end && *colon == ':') {
        const auto [stop, wrong_too] = std::from_chars(colon + 1, end, mark.passed);
        if (wrong_too == std::errc() && stop == end && mark.passed <= most_passed)
            return mark;
    }
    throw Failure(400, "after: " + shown(text) + " is no 'next' of a page");
}

template <typename Value>
std::string text_of(const Bookmark<Value> &mark) {
    return std::to_string(mark.value) + ":" + std::to_string(mark.passed);
}

uint64_t key_of(const locus_text156 &record) {
    uint64_t key = 0;
    check(locus_pmq_key(record.latitude, record.longitude, &key));
    return key;
}

struct Kept {
    int64_t time;
    uint64_t place; // in the store's order
    locus_text156 record;
};

bool newer(const Kept &a, const Kept &b) { return a.time != b.time ? a.time > b.time : a.place < b.place; }

// The `count` newest records of the query, newest first.
std::vector<Kept> newest(const locus_pmq *store, const locus_pmq_query &query, size_t count) {
    std::vector<Kept> heap; // the oldest kept one on top
    uint64_t place = 0;
    visit_records(store, query, [&](const locus_text156 &record) {
        const Kept next{record.time, place++, record};
        if (heap.size() == count) {
            if (!newer(next, heap.front()))
                return true;
            std::pop_heap(heap.begin(), heap.end(), newer);
            heap.pop_back();
        }
        heap.push_back(next);
        std::push_heap(heap.begin(), heap.end(), newer);
        return true;
    });
    std::sort_heap(heap.begin(), heap.end(), newer);
    return heap;
}

} // namespace

Page newest_page(const locus_pmq *store, const locus_pmq_query &query, size_t limit, const std::string &after) {
    const auto mark = bookmark_of(after, INT64_MAX);
    locus_pmq_query rest = query;
    rest.time_to = std::min(query.time_to, mark.value);
    // A record that has expired meanwhile only makes fewer be left out; one more tells whether there is a next page.
    const auto all = newest(store, rest, mark.passed + limit + 1);
    size_t skip = 0;
    while (skip < all.size() && skip < mark.passed && all[skip].time == mark.value)
        ++skip;
    Page page;
    const size_t end = std::min(all.size(), skip + limit);
    for (size_t i = skip; i < end; ++i)
        page.records.push_back(all[i].record);
    if (end < all.size()) {
        const int64_t time = all[end - 1].time;
        const auto same = std::count_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(end),
                                        [time](const Kept &kept) { return kept.time == time; });
        page.next = text_of(Bookmark<int64_t>{time, static_cast<size_t>(same)});
    }
    return page;
}

Page place_page(const locus_pmq *store, const locus_pmq_query &query, size_t limit, const std::string &after) {
    const auto [key, passed] = bookmark_of(after, uint64_t{0});
    Page page;
    size_t capacity = passed + limit + 1; // one more tells whether there is a next page
    locus_pmq_cursor cursor{};
    for (;;) {
        cursor = {key, 0};
        page.records.resize(capacity);
        size_t count = 0;
        const locus_status status = locus_pmq_read_page(store, &query, &cursor, page.records.data(), capacity, &count);
        if (status == LOCUS_E_CAPACITY && count <= most_passed + limit) {
            capacity = count; // all of one place, of which some pages are made
            continue;
        }
        check(status);
        page.records.resize(count);
        break;
    }
    const size_t end = std::min(page.records.size(), passed + limit);
    if (end < page.records.size()) {
        Bookmark<uint64_t> mark{key_of(page.records[end])};
        while (mark.passed < end && key_of(page.records[end - 1 - mark.passed]) == mark.value)
            ++mark.passed;
        page.next = text_of(mark);
    } else if (cursor.key < LOCUS_KEY_END) {
        page.next = text_of(Bookmark<uint64_t>{cursor.key});
    }
    page.records.resize(end);
    page.records.erase(page.records.begin(), page.records.begin() + static_cast<std::ptrdiff_t>(std::min(passed, end)));
    return page;
}

} // namespace explorer
