// A query as the tier asks it: of its own records by key ranges and a selection, of the store by a query of its own.
#pragma once

#include "cold/record.hpp"
#include "core/options.hpp"

#include <locus/pmq.h>

#include <memory>
#include <vector>

namespace locus::cold {

// A call into liblocus that must work.
inline void ask(locus_status status) {
    if (status != LOCUS_OK)
        fail(status, locus_last_error());
}

class Question {
public:
    Question(const locus_pmq_query *query, const RecordFormat &format);

    // Of the store: the same, and what has expired too; `left` receives how many records had left.
    locus_pmq_query of_store(uint64_t *left) const noexcept;
    bool has_snapshot() const noexcept { return query_.snapshot != nullptr; }
    uint64_t *left() const noexcept { return query_.left; }

    const std::vector<locus_key_range> &ranges() const noexcept { return ranges_; }
    int64_t time_from() const noexcept { return query_.time_from; }
    int64_t time_to() const noexcept { return query_.time_to; }
    bool matches(const std::byte *record, bool inside) const;
    bool has_filter() const noexcept { return query_.filter != nullptr; }

private:
    struct Destroy {
        void operator()(locus_pmq_selection *selection) const noexcept { locus_pmq_selection_destroy(selection); }
    };
    locus_pmq_query query_;
    std::unique_ptr<locus_pmq_selection, Destroy> selection_;
    std::vector<locus_key_range> ranges_;
};

} // namespace locus::cold
