// The makers of the engines, one file each.
#pragma once

#include "graph/engine.hpp"

namespace locus::graph {

std::unique_ptr<Engine> make_heap_engine();   // heap.cpp
std::unique_ptr<Engine> make_bucket_engine(); // bucket.cpp
std::unique_ptr<Engine> make_relax_engine();  // relax.cpp
std::unique_ptr<Engine> make_brick_engine();  // bricks/engine.cpp

} // namespace locus::graph
