// Turning pages.
#include "explorer/pages.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace explorer {
namespace {

constexpr size_t most_passed = 200'000;
constexpr int64_t hour = 3'600'000'000; // microseconds

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
std::vector<Kept> newest(const Tiers &tiers, const locus_pmq_query &query, size_t count) {
    std::vector<Kept> heap; // the oldest kept one on top
    uint64_t place = 0;
    visit_records(tiers, query, [&](const locus_text156 &record) {
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

// The same over both tiers, the second of which may be large: the latest hours are looked at first, and what is older
// only where they hold too few.
std::vector<Kept> newest_of_both(const Tiers &tiers, const locus_pmq_query &query, size_t count) {
    const int64_t end = std::min(query.time_to, tiers.now);
    for (const int64_t hours : {1, 8, 64}) {
        const int64_t span = hours * hour;
        locus_pmq_query part = query;
        if (end < INT64_MIN + span || end - span <= query.time_from)
            break;
        part.time_from = end - span;
        auto found = newest(tiers, part, count);
        if (found.size() == count)
            return found;
    }
    return newest(tiers, query, count);
}

// Along the Z-curve, from the key on.
std::vector<locus_text156> by_place_of_both(const Tiers &tiers, const locus_pmq_query &query, uint64_t from,
                                            size_t count) {
    std::vector<locus_text156> records;
    visit_records(tiers, query, [&](const locus_text156 &record) {
        if (from == 0 || key_of(record) >= from)
            records.push_back(record);
        return records.size() < count;
    });
    return records;
}

// The same from the store, which finds the key at once. There may be more, from the key `next` on, if that is below
// LOCUS_KEY_END.
std::vector<locus_text156> by_place(const locus_pmq *store, const locus_pmq_query &query, uint64_t from,
                                    size_t capacity, size_t most, uint64_t &next) {
    for (;;) {
        std::vector<locus_text156> records(capacity);
        locus_pmq_cursor cursor{from, 0};
        size_t count = 0;
        const locus_status status = locus_pmq_read_page(store, &query, &cursor, records.data(), capacity, &count);
        if (status == LOCUS_E_CAPACITY && count <= most) {
            capacity = count; // all of one place, of which some pages are made
            continue;
        }
        check(status);
        records.resize(count);
        next = cursor.key;
        return records;
    }
}

} // namespace

Page newest_page(const Tiers &tiers, const locus_pmq_query &query, size_t limit, const std::string &after) {
    const auto mark = bookmark_of(after, INT64_MAX);
    locus_pmq_query rest = query;
    rest.time_to = std::min(query.time_to, mark.value);
    // A record that has expired meanwhile only makes fewer be left out; one more tells whether there is a next page.
    const auto found = tiers.older != nullptr ? newest_of_both : newest;
    const auto all = found(tiers, rest, mark.passed + limit + 1);
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

Page place_page(const Tiers &tiers, const locus_pmq_query &query, size_t limit, const std::string &after) {
    const auto [key, passed] = bookmark_of(after, uint64_t{0});
    Page page;
    const size_t capacity = passed + limit + 1; // one more tells whether there is a next page
    uint64_t next = LOCUS_KEY_END;
    page.records = tiers.older != nullptr ? by_place_of_both(tiers, query, key, capacity)
                                          : by_place(tiers.store, query, key, capacity, most_passed + limit, next);
    const size_t end = std::min(page.records.size(), passed + limit);
    if (end < page.records.size()) {
        Bookmark<uint64_t> mark{key_of(page.records[end])};
        while (mark.passed < end && key_of(page.records[end - 1 - mark.passed]) == mark.value)
            ++mark.passed;
        page.next = text_of(mark);
    } else if (next < LOCUS_KEY_END) {
        page.next = text_of(Bookmark<uint64_t>{next});
    }
    page.records.resize(end);
    page.records.erase(page.records.begin(), page.records.begin() + static_cast<std::ptrdiff_t>(std::min(passed, end)));
    return page;
}

} // namespace explorer
