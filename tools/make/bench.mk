# The benchmarks: one program, tests/bench, linked with the static libraries; see docs/benchmarks.md.
# Peers are compiled in where their headers are there, so the program builds with the library's own packages alone.
BENCH_SOURCES := $(wildcard tests/bench/*/*.cpp)
BENCH_OBJECTS := $(BENCH_SOURCES:%=$(OUT)/%.o)
BENCH_PROGRAM := $(OUT)/tests/bench_locus
BENCH_COMMIT := $(shell git describe --always --dirty --exclude '*' 2>/dev/null || echo unknown)
# Libraries of the peers and of the compressed data, each where its header is found.
bench_library = $(if $(shell echo '#include <$(1)>' | $(CXX) -E -xc++ - >/dev/null 2>&1 && echo yes),$(2))
bench_libraries = $(call bench_library,zstd.h,-lzstd) $(call bench_library,sqlite3.h,-lsqlite3) \
    $(call bench_library,hiredis/hiredis.h,-lhiredis) $(call bench_library,postgresql/libpq-fe.h,-lpq) \
    $(call bench_library,absl/container/btree_map.h,-labsl_throw_delegate -labsl_raw_logging_internal)

$(BENCH_OBJECTS): EXTRA_CPPFLAGS += -I.
ifneq ($(filter bench,$(MAKECMDGOALS)),)
$(BENCH_OBJECTS): | $(call needs,bench)
endif

# So is the cold tier, which needs a package, where none is installed.
BENCH_COLD := $(if $(SKIP_PACKAGES),$(call bench_library,sqlite3.h,yes),yes)
$(BENCH_PROGRAM): $(BENCH_OBJECTS) $(if $(BENCH_COLD),$(STATIC_locus_cold)) $(LIB_STATIC)
	@echo "  LD  $@"
	@$(CXX) $^ $(if $(BENCH_COLD),$(LIBS_locus_cold)) $(bench_libraries) $(LDFLAGS_ALL) -o $@

.PHONY: bench bench-deps bench-plots check-bench
bench: $(BENCH_PROGRAM) ## run the benchmarks into build/bench.jsonl; ONLY=regex for some, QUICK=1 for small sizes
	@BENCH_COMMIT=$(BENCH_COMMIT) $< --out build/bench.jsonl $(if $(ONLY),--only '$(ONLY)') $(if $(QUICK),--quick)

bench-deps: packages-bench packages-bench-deps ## install the optional peers of the benchmarks: databases, scikit-image

bench-plots: | $(call needs,plots) ## draw tables 3.2, 3.3 and figures 3.8 to 3.10 of the thesis from build/bench.jsonl into build
	@/usr/bin/python3 tests/bench/plot.py build/bench.jsonl build

# A small run of a case of each kind: the answers of ours and of the peers that were found are compared.
CHECK_CASES := pmq\.(insert\.1M\.b100|window\.10M8\.b1000|readers\.1|count\.30km|read\.30km|cold\..*|tile\.z4|topk.*)|voronoi\.(cube128\.(gradient|maze)|plate)\.s[0-9]+|update.*
check: check-bench
check-bench: $(BENCH_PROGRAM)
	$(STAGE) $@ $< --quick --out $(OUT)/bench-smoke.jsonl --only '^($(CHECK_CASES))$$'
