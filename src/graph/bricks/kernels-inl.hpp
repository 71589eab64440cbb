// The table of kernels of the instruction set being compiled. Included by the same rules as pull-inl.hpp, last.

namespace locus::bricks::LOCUS_LANES_NAMESPACE {

template <typename Word, typename Kernel>
void visit_by(Visit<Word> &visit) {
    Kernel(visit).run();
}

template <typename Word>
constexpr Kernels<Word> kernels_of() {
    return {visit_by<Word, MeanVisit<Word, true>>, visit_by<Word, MeanVisit<Word, false>>,
            visit_by<Word, EdgeVisit<Word, MeanWeight<Word>>>, visit_by<Word, EdgeVisit<Word, MaxWeight<Word>>>,
            visit_by<Word, EdgeVisit<Word, StiffnessWeight<Word>>>};
}

static const KernelTable table = {kernels_of<uint32_t>(), kernels_of<uint64_t>()};

} // namespace locus::bricks::LOCUS_LANES_NAMESPACE
