// From a Launch to the body it means: run_*(runner, launch) call runner.items<Body>(launch) or
// runner.blocks<Body>(launch) with the body's type, and return what that returns. One function per group of kernels, so
// that each may be compiled on its own.
#pragma once

#include "graph/device/dense.hpp"
#include "graph/device/rules.hpp"
#include "graph/device/sibson.hpp"
#include "graph/device/table.hpp"
#include "graph/device/transfer.hpp"
#include "graph/device/visit.hpp"

namespace locus::device {

template <template <typename> typename Body, typename Runner>
int32_t run_by_word(Runner &runner, const Launch &launch) {
    return launch.word_bits == 32 ? runner.template items<Body<uint32_t>>(launch)
                                  : runner.template items<Body<uint64_t>>(launch);
}

// run(word, rule) with values of the types meant.
template <typename Word, typename Run>
int32_t with_rule(uint32_t kind, Run &&run) {
    switch (static_cast<RuleKind>(kind)) {
    case RuleKind::half_sum:
        return run(Word{}, HalfSumRule<Word>{});
    case RuleKind::larger:
        return run(Word{}, LargerRule<Word>{});
    case RuleKind::stiffness:
        return run(Word{}, StiffnessRule<Word>{});
    case RuleKind::power:
        return run(Word{}, PowerRule<Word>{});
    }
    return LOCUS_E_INTERNAL;
}
template <typename Run>
int32_t with_rule(const Launch &launch, Run &&run) {
    return launch.word_bits == 32 ? with_rule<uint32_t>(launch.rule, run) : with_rule<uint64_t>(launch.rule, run);
}

template <bool raising, typename Runner>
int32_t run_visit(Runner &runner, const Launch &launch) {
    if (launch.simple != 0 && launch.rule == static_cast<uint32_t>(RuleKind::half_sum))
        return launch.word_bits == 32
                   ? runner.template blocks<Visit<uint32_t, HalfSumRule<uint32_t>, HalfSumCells<uint32_t>, raising>>(
                         launch)
                   : runner.template blocks<Visit<uint64_t, HalfSumRule<uint64_t>, HalfSumCells<uint64_t>, raising>>(
                         launch);
    return with_rule(launch, [&]<typename Word, typename Rule>(Word, Rule) {
        return runner.template blocks<Visit<Word, Rule, EdgeCells<Word, Rule>, raising>>(launch);
    });
}

template <typename Runner>
int32_t run_relax(Runner &runner, const Launch &launch) {
    return with_rule(launch, [&]<typename Word, typename Rule>(Word, Rule) {
        return runner.template items<Relax<Word, Rule>>(launch);
    });
}

template <typename Runner>
int32_t run_sibson(Runner &runner, const Launch &launch) {
    return with_rule(launch, [&]<typename Word, typename Rule>(Word, Rule) {
        return launch.kernel == Kernel::sibson ? runner.template blocks<Sibson<Word, Rule, false>>(launch)
                                               : runner.template blocks<Sibson<Word, Rule, true>>(launch);
    });
}

// The kernels that ask for no weights.
template <typename Runner>
int32_t run_plain(Runner &runner, const Launch &launch) {
    switch (launch.kernel) {
    case Kernel::fill_bytes:
        return runner.template items<Fill<uint8_t>>(launch);
    case Kernel::fill_words:
        return run_by_word<Fill>(runner, launch);
    case Kernel::select:
        return runner.template items<Select>(launch);
    case Kernel::wake_list:
        return runner.template items<WakeList>(launch);
    case Kernel::plant:
        return run_by_word<Plant>(runner, launch);
    case Kernel::resume:
        return launch.word_bits == 32 ? runner.template blocks<Resume<uint32_t>>(launch)
                                      : runner.template blocks<Resume<uint64_t>>(launch);
    case Kernel::import:
        return runner.template items<Import>(launch);
    case Kernel::scatter_operands:
        return runner.template items<Scatter<float>>(launch);
    case Kernel::scatter_open:
        return runner.template items<Scatter<uint32_t>>(launch);
    case Kernel::gather:
        return run_by_word<Gather>(runner, launch);
    case Kernel::export_words:
        return run_by_word<Export>(runner, launch);
    case Kernel::read:
        return run_by_word<Read>(runner, launch);
    case Kernel::tally:
        return launch.word_bits == 32 ? runner.template blocks<Tally<uint32_t>>(launch)
                                      : runner.template blocks<Tally<uint64_t>>(launch);
    case Kernel::update:
        return run_by_word<Update>(runner, launch);
    case Kernel::sow:
        return run_by_word<Sow>(runner, launch);
    default:
        return LOCUS_E_INTERNAL;
    }
}

} // namespace locus::device
