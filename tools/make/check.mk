# The long tier: everything `make check` runs beside `make test`. Other flags are other makes with folders of their own; what the quick tier
# has built is used where the flags are the same.
CHECKS := check-address check-thread check-scalar check-memcheck check-fuzz check-deb check-format
.PHONY: check $(CHECKS)
check: $(CHECKS) ## the long tests: sanitizers, clang, SIMD=scalar, fuzzing, the form of the sources, the Debian package
	@echo "make check: all passed"

# The areas whose tests use threads.
THREADED := unit-core unit-graph unit-weights unit-pmq unit-cold unit-cuda
# Long tests among them that use one, or several as shorter ones do: the thread sanitizer would see nothing new in them.
ONE_THREADED := *.EveryInstructionSet*:Natural.LaplaceCountsFaces*:Update.DistanceRatiosFollow*:Search.*:Alerts.*:Insert.*:Log.*:Regions.*:*/Killed*:StorageFaults.*:*Memory.*:CudaFailures.*:Cuda*.EqualTheHeap*:Cuda*.*AfterRandomEdits:Cuda*.Brings*:CudaSibson.[GW]*

# clang's address sanitizer: g++'s does not see what masked vector stores write.
check-address: | $(call needs,test check)
	@+$(MAKE) --no-print-directory SANITIZE=address CXX=clang++ CC=clang unit api
check-thread: | $(call needs,test)
	@+GTEST_FILTER='-$(ONE_THREADED)' $(MAKE) --no-print-directory SANITIZE=thread SIMD=scalar $(THREADED)
check-scalar: | $(call needs,test)
	@+$(MAKE) --no-print-directory SIMD=scalar unit api

# Valgrind over more of the unit tests than the quick tier runs.
check-memcheck: | $(call needs,test)
	@+$(MAKE) --no-print-directory MEMCHECK_MS=1200 $(MEMCHECK_UNIT)

# Fuzzing: every tests/fuzz/NAME.cpp is a libFuzzer program over the static libraries; it runs FUZZ_RUNS inputs from a fixed seed,
# starting with those in tests/fuzz/corpus/NAME if there is such a folder; what it finds worth keeping goes into the first folder it is
# given, one of the build's, empty each time. FUZZ_RUNS_NAME and FUZZ_FLAGS_NAME are its own.
FUZZ_RUNS ?= 20000
FUZZERS := $(patsubst tests/fuzz/%.cpp,%,$(wildcard tests/fuzz/*.cpp))
$(FUZZERS:%=$(OUT)/tests/fuzz/%.cpp.o): | $(call needs,check)
$(OUT)/tests/fuzz/%: $(OUT)/tests/fuzz/%.cpp.o $(foreach name,$(LIBRARIES),$(STATIC_$(name)))
	@echo "  LD  $@"
	@$(CXX) $(filter %.o,$^) $(STATIC_LINK) -fsanitize=fuzzer $(LDFLAGS_ALL) -o $@
.PHONY: $(FUZZERS:%=fuzz-%) fuzz
$(FUZZERS:%=fuzz-%): fuzz-%: $(OUT)/tests/fuzz/%
	@rm -rf $(OUT)/fuzz/$* && mkdir -p $(OUT)/fuzz/$*/found
	$(STAGE) $(FLAVOUR)$@ $< -seed=1 -runs=$(or $(FUZZ_RUNS_$*),$(FUZZ_RUNS)) -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
	    -artifact_prefix=$(OUT)/fuzz/$*/ $(FUZZ_FLAGS_$*) $(OUT)/fuzz/$*/found $(wildcard tests/fuzz/corpus/$*)
check-fuzz: | $(call needs,test check)
	@+$(if $(FUZZERS),$(MAKE) --no-print-directory SANITIZE=fuzzer CXX=clang++ CC=clang $(FUZZERS:%=fuzz-%))

# The form of the sources: clang-format, length, words that do not belong into a source.
check-format: | $(call needs,check)
	$(STAGE) $@ tests/format.sh

# The Debian package: builds, installs into a scratch root, links, is removed without a trace.
check-deb: deb
	$(STAGE) $@ tests/install/deb.sh $(DEB)
