// What a store can be made from: the options' ranges, and the layout they ask for.
#pragma once

#include "pmq/layout/layout.hpp"

#include <memory>

namespace locus::pmq {

locus_pmq_options default_options() noexcept;
// Throws Error(LOCUS_E_ARGUMENT), which names the option and its value.
void check_options(const locus_pmq_options &options);
const RecordFormat &record_format(const locus_pmq_options &options) noexcept;
std::unique_ptr<Layout> make_layout(const locus_pmq_options &options);

} // namespace locus::pmq
