// Pages of an ordered iteration: the records behind a cursor.
#include "core/error.hpp"
#include "pmq/query/queries.hpp"
#include "pmq/query/ranges.hpp"

namespace locus::pmq {
namespace {

// The part of a region (nullptr: of everywhere) whose keys lie in a range.
class KeyWindow final : public Region {
public:
    KeyWindow(const Region *inner, const KeyRange &keys) noexcept : inner_(inner), keys_(keys) {}

    Relation relate(const Quadrant &quadrant) const noexcept override {
        const KeyRange range = quadrant.keys();
        if (range.hi <= keys_.lo || range.lo >= keys_.hi)
            return Relation::outside;
        const Relation relation = inner_ ? inner_->relate(quadrant) : Relation::inside;
        const bool whole = keys_.lo <= range.lo && range.hi <= keys_.hi;
        return whole || relation == Relation::outside ? relation : Relation::edge;
    }
    Relation relate(uint64_t key) const noexcept override {
        if (!keys_.contains(key))
            return Relation::outside;
        return inner_ ? inner_->relate(key) : Relation::inside;
    }
    bool contains(double latitude, double longitude) const noexcept override {
        return !inner_ || inner_->contains(latitude, longitude);
    }

private:
    const Region *inner_;
    KeyRange keys_;
};

class Page {
public:
    Page(const View &view, const Selection &selection, const locus_pmq_cursor &from, std::byte *records,
         size_t capacity)
        : view_(view), selection_(selection), from_(from), records_(records), capacity_(capacity), skip_(from.passed),
          run_key_(from.key), run_passed_(from.passed) {}

    void fill() {
        const KeyWindow rest(selection_.region, {from_.key, key_end});
        Selection behind = selection_;
        behind.region = &rest;
        overflow_ = !for_each_record(view_, behind, Order::key,
                                     [this](uint64_t key, Bytes record) { return take(key, record); });
    }

    // End before the records of the key that do not all fit. False if nothing is left then.
    bool end_between_keys() noexcept {
        if (overflow_ && next_key_ == run_key_) {
            found_ = run_begin_;
            run_passed_ = 0;
        }
        return !overflow_ || found_ > 0;
    }
    uint64_t records_of_next_key() const {
        const KeyWindow one(selection_.region, {next_key_, next_key_ + 1});
        Selection there = selection_;
        there.region = &one;
        return count(view_, there);
    }
    size_t found() const noexcept { return found_; }
    locus_pmq_cursor end() const noexcept {
        if (!overflow_)
            return {LOCUS_KEY_END, 0};
        return {next_key_, next_key_ == run_key_ ? run_passed_ : 0};
    }

private:
    bool take(uint64_t key, Bytes record) {
        if (skip_ > 0 && key == from_.key) {
            --skip_;
            return true;
        }
        if (found_ == capacity_) {
            next_key_ = key;
            return false;
        }
        if (key != run_key_) {
            run_key_ = key;
            run_begin_ = found_;
            run_passed_ = 0;
        }
        const size_t size = view_.format().size;
        copy_record(records_ + found_++ * size, record, size);
        ++run_passed_;
        return true;
    }

    const View &view_;
    const Selection &selection_;
    const locus_pmq_cursor from_;
    std::byte *const records_;
    const size_t capacity_;
    uint64_t skip_;
    size_t found_ = 0;
    // The latest key: where in the page its records begin, and how many of them have been passed, on earlier pages too.
    uint64_t run_key_;
    size_t run_begin_ = 0;
    uint64_t run_passed_;
    bool overflow_ = false; // there is a record behind the page,
    uint64_t next_key_ = 0; // of this key
};

} // namespace

size_t read_page(const View &view, const Selection &selection, bool lasting, locus_pmq_cursor &cursor,
                 std::byte *records, size_t capacity, size_t &needed) {
    if (cursor.key >= LOCUS_KEY_END)
        return 0;
    Page page(view, selection, cursor, records, capacity);
    page.fill();
    if (!lasting && !page.end_between_keys()) {
        needed = page.records_of_next_key();
        fail(LOCUS_E_CAPACITY, "capacity is ", capacity, ", the key ", page.end().key, " has ", needed, " records");
    }
    cursor = page.end();
    return page.found();
}

} // namespace locus::pmq
