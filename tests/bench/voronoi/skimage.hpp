// Outside peer: scikit-image's minimal-cost paths on the same cube.
#ifndef LOCUS_BENCH_SKIMAGE_HPP
#define LOCUS_BENCH_SKIMAGE_HPP

#include "tests/bench/harness/row.hpp"

namespace bench {

void skimage_case(Row &row);

} // namespace bench
#endif
