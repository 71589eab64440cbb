// Owners of the library's handles for the benchmarks; a failed call becomes an exception with the library's text.
#ifndef LOCUS_BENCH_HANDLES_HPP
#define LOCUS_BENCH_HANDLES_HPP

#include <locus/locus.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace bench {

inline void need(locus_status status) {
    if (status != LOCUS_OK) {
        throw std::runtime_error(std::string(locus_status_name(status)) + ": " + locus_last_error());
    }
}

template <auto destroy>
struct Destroy {
    template <class Handle>
    void operator()(Handle *handle) const {
        destroy(handle);
    }
};
using Pmq = std::unique_ptr<locus_pmq, Destroy<locus_pmq_destroy>>;
using Graph = std::unique_ptr<locus_graph, Destroy<locus_graph_destroy>>;
using Diagram = std::unique_ptr<locus_diagram, Destroy<locus_diagram_destroy>>;

inline Pmq make_pmq(const locus_pmq_options &options) {
    locus_pmq *pmq = nullptr;
    need(locus_pmq_create(&options, &pmq));
    return Pmq(pmq);
}
inline Graph make_graph(const locus_graph_options &options, const float *material) {
    locus_graph *graph = nullptr;
    need(locus_graph_create(&options, material, &graph));
    return Graph(graph);
}
inline Diagram make_diagram(const Graph &graph, const locus_diagram_options &options) {
    locus_diagram *diagram = nullptr;
    need(locus_diagram_create(graph.get(), &options, &diagram));
    return Diagram(diagram);
}

} // namespace bench
#endif
