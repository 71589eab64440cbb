// Peers of figure 3.6: spatial databases, each started and stopped by the benchmark itself.
#ifndef LOCUS_BENCH_DATABASES_HPP
#define LOCUS_BENCH_DATABASES_HPP

#include <locus/pmq.h>

#include <memory>
#include <span>
#include <vector>

namespace bench {

class Database {
public:
    virtual ~Database() = default;
    virtual void insert(std::span<const locus_point32> batch) = 0;
    /// All records, copied into `out`, which has room for them; their number.
    virtual std::size_t read_all(std::span<locus_point32> out) = 0;
};

// Each throws Missing where its library or server is not there.
std::unique_ptr<Database> make_sqlite_rtree();
std::unique_ptr<Database> make_spatialite();
std::unique_ptr<Database> make_postgis();
std::unique_ptr<Database> make_redis_geo();

} // namespace bench
#endif
