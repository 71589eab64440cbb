// Kernel bodies and what runs them. A body is a plain struct that holds its parameters. There are two forms:
// - by index: count() says how many items there are, operator()(i) does item i, in any order and at the same time;
// - by block: operator()(block) is run by blocks of `threads` threads that share a `Shared` and keep a `Local` each. It
//   is written as phases, block.each([&](unsigned thread, Local &local) { ... }), with a barrier after each; between
//   phases there are only uniform decisions, from parameters and from what is shared. block.memory() is shared too:
//   Launch::memory bytes, aligned to 16.
// The same bodies are compiled into kernels (cuda/) and run by a host launcher in the tests.
#pragma once

#include "core/word.hpp"

#ifdef __CUDACC__
#define LOCUS_UNROLL _Pragma("unroll")
#else
#define LOCUS_UNROLL
#endif
