// The operations on a row of sixteen words, by Highway, for the target being compiled. No include guard: once per
// target.

namespace locus::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename Word>
struct Lanes {
    // The wide word as a signed number: its minimum is cheaper, and no sum reaches the sign.
    using Lane = std::conditional_t<sizeof(Word) == 4, uint32_t, int64_t>;
    using D = hn::CappedTag<Lane, kLanes>;
    using V = hn::Vec<D>;
    using R = hn::Rebind<Real<Word>, D>;
    static constexpr unsigned kPer = static_cast<unsigned>(hn::MaxLanes(D()));
    static constexpr unsigned kParts = kLanes / kPer;
    struct Row {
        V part[kParts];
    };

    static HWY_INLINE const Lane *lanes(const Word *p) { return reinterpret_cast<const Lane *>(p); }
    static HWY_INLINE Row all(Word w) {
        Row r;
        for (unsigned p = 0; p < kParts; ++p)
            r.part[p] = hn::Set(D(), static_cast<Lane>(w));
        return r;
    }
    static HWY_INLINE Row load(const Word *from) {
        Row r;
        for (unsigned p = 0; p < kParts; ++p)
            r.part[p] = hn::Load(D(), lanes(from) + p * kPer);
        return r;
    }
    static HWY_INLINE void store(Row a, Word *to) {
        for (unsigned p = 0; p < kParts; ++p)
            hn::Store(a.part[p], D(), reinterpret_cast<Lane *>(to) + p * kPer);
    }
    static HWY_INLINE Row add(Row a, Row b) {
        for (unsigned p = 0; p < kParts; ++p)
            a.part[p] = hn::Add(a.part[p], b.part[p]);
        return a;
    }
    static HWY_INLINE Row min(Row a, Row b) {
        for (unsigned p = 0; p < kParts; ++p)
            a.part[p] = hn::Min(a.part[p], b.part[p]);
        return a;
    }
    // The operands of a row's voxels as the bits of Real numbers.
    static HWY_INLINE Row operand(const float *from) {
        Row r;
        for (unsigned p = 0; p < kParts; ++p) {
            const auto v = hn::Load(hn::Rebind<float, D>(), from + p * kPer);
            if constexpr (sizeof(Word) == 4)
                r.part[p] = hn::BitCast(D(), v);
            else
                r.part[p] = hn::BitCast(D(), hn::PromoteTo(R(), v));
        }
        return r;
    }
    static HWY_INLINE Row larger(Row a, Row b) {
        for (unsigned p = 0; p < kParts; ++p)
            a.part[p] = hn::BitCast(D(), hn::Max(hn::BitCast(R(), a.part[p]), hn::BitCast(R(), b.part[p])));
        return a;
    }
    static HWY_INLINE Row sum(Row a, Row b) {
        for (unsigned p = 0; p < kParts; ++p)
            a.part[p] = hn::BitCast(D(), hn::Add(hn::BitCast(R(), a.part[p]), hn::BitCast(R(), b.part[p])));
        return a;
    }
    // Operand times factor, or factor over operand, in steps shifted to the distance's place.
    static HWY_INLINE Row share(Row operand, Real<Word> factor, Real<Word> low, Real<Word> cap, uint32_t label_bits) {
        for (unsigned p = 0; p < kParts; ++p)
            operand.part[p] =
                steps(hn::Mul(hn::BitCast(R(), operand.part[p]), hn::Set(R(), factor)), low, cap, label_bits);
        return operand;
    }
    static HWY_INLINE Row quotient(Row operand, Real<Word> factor, Real<Word> low, Real<Word> cap,
                                   uint32_t label_bits) {
        for (unsigned p = 0; p < kParts; ++p)
            operand.part[p] =
                steps(hn::Div(hn::Set(R(), factor), hn::BitCast(R(), operand.part[p])), low, cap, label_bits);
        return operand;
    }
    // `a` where the operand is above zero, `otherwise` elsewhere.
    static HWY_INLINE Row where_positive(Row operand, Row a, Row otherwise) {
        for (unsigned p = 0; p < kParts; ++p) {
            const auto positive = hn::Gt(hn::BitCast(R(), operand.part[p]), hn::Zero(R()));
            a.part[p] = hn::IfThenElse(hn::RebindMask(D(), positive), a.part[p], otherwise.part[p]);
        }
        return a;
    }
    // `otherwise` in the lanes whose bit is set, `a` elsewhere.
    static HWY_INLINE Row blocked(Row a, uint32_t bits, Row otherwise) {
        for (unsigned p = 0; p < kParts; ++p) {
            uint8_t bytes[8] = {};
            const auto part = static_cast<uint16_t>(bits >> (p * kPer) & ((1u << kPer) - 1));
            __builtin_memcpy(bytes, &part, 2);
            a.part[p] = hn::IfThenElse(hn::LoadMaskBits(D(), bytes), otherwise.part[p], a.part[p]);
        }
        return a;
    }

    // Lane i of the result is lane i - 1, or i + 1, of `a`; what comes in from outside is `fill`.
    static HWY_INLINE Row left(Row a, Row fill) {
        Row r;
        for (unsigned p = 0; p < kParts; ++p)
            r.part[p] = after(p == 0 ? fill.part[0] : a.part[p - 1], a.part[p]);
        return r;
    }
    static HWY_INLINE Row right(Row a, Row fill) {
        Row r;
        for (unsigned p = 0; p < kParts; ++p)
            r.part[p] = before(a.part[p], p + 1 == kParts ? fill.part[0] : a.part[p + 1]);
        return r;
    }

    // One bit per lane.
    static HWY_INLINE uint32_t differ(Row a, Row b) {
        uint32_t bits = 0;
        for (unsigned p = 0; p < kParts; ++p) {
            uint8_t bytes[8] = {};
            hn::StoreMaskBits(D(), hn::Ne(a.part[p], b.part[p]), bytes);
            uint16_t low;
            __builtin_memcpy(&low, bytes, 2);
            bits |= uint32_t{low} << (p * kPer);
        }
        return bits;
    }
    static HWY_INLINE Row where_differ(Row a, Row b, Row otherwise) {
        for (unsigned p = 0; p < kParts; ++p)
            a.part[p] = hn::IfThenElse(hn::Ne(a.part[p], b.part[p]), a.part[p], otherwise.part[p]);
        return a;
    }
    // `a` with lanes 0 and 15 of `border`.
    static HWY_INLINE Row inner(Row a, Row border) {
        const auto first = hn::FirstN(D(), 1);
        const auto rest = hn::FirstN(D(), kPer - 1);
        a.part[0] = hn::IfThenElse(first, border.part[0], a.part[0]);
        a.part[kParts - 1] = hn::IfThenElse(rest, a.part[kParts - 1], border.part[kParts - 1]);
        return a;
    }

private:
    static HWY_INLINE V steps(hn::Vec<R> x, Real<Word> low, Real<Word> cap, uint32_t label_bits) {
        const auto clamped = hn::Min(hn::Max(x, hn::Set(R(), low)), hn::Set(R(), cap));
        V rounded;
        if constexpr (sizeof(Word) == 4) {
            rounded = hn::BitCast(D(), hn::NearestInt(clamped));
        } else { // adding 2^52 leaves the nearest integer in the mantissa
            const auto magic = hn::Set(R(), 0x1p52);
            rounded = hn::Sub(hn::BitCast(D(), hn::Add(clamped, magic)), hn::BitCast(D(), magic));
        }
        return hn::ShiftLeftSame(rounded, static_cast<int>(label_bits));
    }

    // The last lane of `a`, then all but the last of `b`.
    static HWY_INLINE V after(V a, V b) {
        constexpr D d;
        if constexpr (kPer * sizeof(Lane) == 16) {
            return hn::CombineShiftRightBytes<16 - sizeof(Lane)>(d, b, a);
        } else if constexpr (kPer * sizeof(Lane) == 32) {
            return hn::CombineShiftRightBytes<16 - sizeof(Lane)>(d, b, hn::ConcatLowerUpper(d, b, a));
        } else {
            const auto turn = hn::IndicesFromVec(d, hn::And(hn::Iota(d, kPer - 1), hn::Set(d, kPer - 1)));
            return hn::IfThenElse(hn::FirstN(d, 1), hn::TableLookupLanes(a, turn), hn::TableLookupLanes(b, turn));
        }
    }
    // All but the first lane of `a`, then the first of `b`.
    static HWY_INLINE V before(V a, V b) {
        constexpr D d;
        if constexpr (kPer * sizeof(Lane) == 16) {
            return hn::CombineShiftRightBytes<sizeof(Lane)>(d, b, a);
        } else if constexpr (kPer * sizeof(Lane) == 32) {
            return hn::CombineShiftRightBytes<sizeof(Lane)>(d, hn::ConcatLowerUpper(d, b, a), a);
        } else {
            const auto turn = hn::IndicesFromVec(d, hn::And(hn::Iota(d, 1), hn::Set(d, kPer - 1)));
            return hn::IfThenElse(hn::FirstN(d, kPer - 1), hn::TableLookupLanes(a, turn),
                                  hn::TableLookupLanes(b, turn));
        }
    }
};

} // namespace locus::bricks::HWY_NAMESPACE
