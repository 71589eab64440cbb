// The Web-Mercator projection, written once for doubles and for vectors of them. No function of the mathematical
// library, whose last digit depends on the processor: only +, -, *, / and comparisons, so that every instruction set
// finds the same key. Included once per target, inside LOCUS_LANES_NAMESPACE; `Ops` says what a vector cannot with
// operators.
namespace locus::LOCUS_LANES_NAMESPACE {

constexpr uint64_t half_root_bits = 0x3FE6A09E667F3BCD; // of sqrt(1/2) as a double
constexpr uint64_t two_52_bits = 0x4330000000000000;    // of 2^52

// c[0] + c[1] * x + ..., the highest power first.
template <typename Ops, typename V, size_t n>
LOCUS_INLINE V polynomial(Ops ops, V x, const double (&c)[n]) {
    V sum = ops.set(c[n - 1]);
    for (size_t i = n - 1; i-- > 0;)
        sum = sum * x + ops.set(c[i]);
    return sum;
}

// sin x for |x| <= 1.4845 (the square's edge): Taylor's series, whose next term is below 1e-16.
template <typename Ops, typename V>
LOCUS_INLINE V sine(Ops ops, V x) {
    constexpr double terms[] = {-1.0 / 6,
                                1.0 / 120,
                                -1.0 / 5040,
                                1.0 / 362880,
                                -1.0 / 39916800,
                                1.0 / 6227020800,
                                -1.0 / 1307674368000,
                                1.0 / 355687428096000,
                                -1.0 / 121645100408832000};
    const V square = x * x;
    return x + x * (square * polynomial(ops, square, terms));
}

// ln q = k ln 2 + ln m with m in sqrt(1/2)..sqrt(2), and ln m = 2 artanh t with t = (m - 1) / (m + 1), |t| < 0.172.
template <typename Ops, typename V>
LOCUS_INLINE V logarithm(Ops ops, V q) {
    constexpr double terms[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
    V k, m;
    ops.split(q, k, m);
    const V t = (m - ops.set(1)) / (m + ops.set(1)), square = t * t;
    return k * ops.set(0x1.62e42fefa39efp-1) + (t + t + t * (square * polynomial(ops, square, terms)));
}

// Eastwards from -180 degrees and southwards from the square's northern edge, both 0 <= . < 1.
template <typename Ops, typename V>
LOCUS_INLINE V map_x(Ops ops, V longitude) {
    const V x = ops.min((longitude + ops.set(180)) / ops.set(360), ops.set(last_coordinate));
    return ops.zero_where_at_least(longitude, ops.set(180), x);
}

template <typename Ops, typename V>
LOCUS_INLINE V map_y(Ops ops, V latitude) {
    const V edge = ops.set(mercator_latitude);
    const V within = ops.max(ops.min(latitude, edge), ops.set(0) - edge);
    const V s = sine(ops, within * ops.set(0x1.1df46a2529d39p-6)); // pi / 180
    const V y =
        ops.set(0.5) - logarithm(ops, (ops.set(1) + s) / (ops.set(1) - s)) * ops.set(0x1.45f306dc9c883p-4); // 1 / 4 pi
    return ops.min(ops.max(y, ops.set(0)), ops.set(last_coordinate));
}

} // namespace locus::LOCUS_LANES_NAMESPACE
