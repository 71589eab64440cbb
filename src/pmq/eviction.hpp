// What may go: one pass's question to the horizon and to the caller's predicate.
#pragma once

#include "pmq/record.hpp"

namespace locus::pmq {

class Eviction {
public:
    Eviction(const RecordFormat &format, const Moment &moment, locus_remove_fn remove, void *user)
        : format_(format), moment_(moment), remove_(remove), user_(user) {}

    const RecordFormat &format() const noexcept { return format_; }
    const Moment &moment() const noexcept { return moment_; }
    bool asks() const noexcept { return remove_ != nullptr && !stopped_; }

    bool expired(Bytes record) const noexcept { return format_.time(record) < moment_.cutoff; }
    // Does the caller permit removal? Ask at most once per record and pass. After a negative answer the predicate is
    // asked no more, and the pass takes back what it permitted before.
    bool permitted(Bytes record) noexcept {
        if (!asks())
            return false;
        const int32_t answer = remove_(record, user_);
        stopped_ = answer < 0;
        return answer > 0;
    }
    bool stopped() const noexcept { return stopped_; }

private:
    const RecordFormat &format_;
    Moment moment_;
    locus_remove_fn remove_;
    void *user_;
    bool stopped_ = false;
};

} // namespace locus::pmq
