// Who is told of every batch that a store has taken in.
#pragma once

#include "pmq/layout/layout.hpp"

namespace locus::pmq {

class Observer {
public:
    virtual ~Observer() = default;
    // Once true, the observer is told no more.
    virtual bool ended() const noexcept = 0;
    // A batch has been committed; its records and keys are valid during the call. False if a callback stopped. By the
    // thread that inserts, which holds no lock.
    virtual bool arrived(const Batch &batch, const RecordFormat &format, const Moment &moment) = 0;
};

} // namespace locus::pmq
