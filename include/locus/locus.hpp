/* locus/locus.hpp - C++17 owner types for everything of Locus but the file formats (locus/volume.hpp,
 * locus/records.hpp) and the cold tier (locus/cold.hpp), which are in libraries of their own.
 *
 * locus::graph, diagram, weights, pmq, snapshot and alerts own the handles of the C interface: they move and do not
 * copy, end their handle when they end, and hold nothing else but what their callbacks need. Header-only, on the C
 * interface alone, so the library may be newer than the program. locus/status.hpp tells how errors and callbacks work.
 */
#ifndef LOCUS_LOCUS_HPP
#define LOCUS_LOCUS_HPP

#include <locus/alerts.hpp>
#include <locus/diagram.hpp>
#include <locus/graph.hpp>
#include <locus/pmq.hpp>
#include <locus/status.hpp>
#include <locus/storage.hpp>
#include <locus/weights.hpp>

#endif
