# The quick tier of tests: everything `make test` runs. Each stage logs into $(OUT)/log and prints one line (tools/stage.sh).
STAGE = @tools/stage.sh $(OUT)/log
# In front of a stage's name where the flags are not the usual ones: clang++-address.
FLAVOUR := $(addsuffix .,$(filter-out g++,$(subst -release,,$(OUT:build/%-$(FLAGS_ID)=%))))

.PHONY: test unit api headers exports abi abi-baseline memcheck install-test readme
test: unit api headers exports abi memcheck install-test readme ## the quick tests: units, C programs, headers, ABI, Valgrind, installation
	@echo "make test: all passed"

# Unit tests: one GoogleTest program per folder of tests/unit, linked with the static libraries. UNIT_LIBS_<area>: more it needs;
# UNIT_JOBS_<area>: whose packages it is compiled with.
STATIC_LINK = $(foreach name,$(LIBRARIES),$(STATIC_$(name)) $(LIBS_$(name)) $(BASES_$(name):%=$(OUT)/lib%.a))
# The longest first, so that no core waits for it at the end.
UNIT_AREAS := $(sort $(notdir $(patsubst %/,%,$(dir $(wildcard tests/unit/*/*.cpp)))))
UNIT_AREAS := pmq weights $(filter-out pmq weights,$(UNIT_AREAS))
UNIT_OBJECTS := $(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/*/*.cpp))
$(UNIT_OBJECTS): EXTRA_CPPFLAGS += -I.
# With clang -Wconversion means signs too, which would only clutter the tests with casts.
$(UNIT_OBJECTS): EXTRA_CXXFLAGS += -Wno-sign-conversion $(QUICKLY)
$(UNIT_OBJECTS): | $(call needs,test)
# Calls that a test can make fail.
UNIT_WRAPPED_pmq := mmap open pread pwrite fsync fdatasync ftruncate rename unlink mkdir
UNIT_LIBS_pmq := $(UNIT_WRAPPED_pmq:%=-Wl,--wrap=%)

UNIT_JOBS_io := io
UNIT_JOBS_cold := cold
UNIT_JOBS_examples := demo
define unit_program
$(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/$(1)/*.cpp)): | $(call needs,$(UNIT_JOBS_$(1)))
$(OUT)/tests/unit_$(1): $(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/$(1)/*.cpp)) $(foreach name,$(LIBRARIES),$(STATIC_$(name)))
	@echo "  LD  $$@"
	@$$(CXX) $$(filter %.o,$$^) $$(UNIT_LIBS_$(1)) $$(STATIC_LINK) -lgtest_main -lgtest $$(LDFLAGS_ALL) -o $$@
.PHONY: unit-$(1)
unit-$(1): $(OUT)/tests/unit_$(1)
	$$(STAGE) $(FLAVOUR)unit-$(1) $$< --gtest_brief=1
endef
$(foreach area,$(UNIT_AREAS),$(eval $(call unit_program,$(area))))
unit: $(addprefix unit-,$(UNIT_AREAS)) ## the unit tests only (unit-graph, unit-pmq, ... for one area)

# API tests: C99 programs that see the public headers and the shared libraries only.
# What a C program of clang's needs beside sanitized C++ libraries.
SANITIZED_C := $(if $(and $(SANITIZE),$(findstring clang,$(CXX))),-fsanitize-link-c++-runtime -lstdc++)
API_PROGRAMS := $(patsubst tests/api/%.c,$(OUT)/tests/api/%,$(wildcard tests/api/*.c))
$(OUT)/tests/api/%: tests/api/%.c $(foreach name,$(LIBRARIES),$(SHARED_$(name))) $(wildcard tests/api/*.h) | $(call needs,test)
	@mkdir -p $(@D)
	@echo "  CC  $<"
	@$(CC) -Iinclude $(CPPFLAGS) $(CFLAGS_ALL) -std=c99 -Wstrict-prototypes -MMD -MP -MF $@.d $< -o $@ -L$(OUT) -Wl,--as-needed $(LIBRARIES:%=-l%) \
	    -Wl,-rpath,'$$ORIGIN/../..' $(LDFLAGS_ALL) $(SANITIZED_C) -lm
# The sanitizers keep what dlclose lets go; and they replace malloc, as the test of memory that runs out does.
API_TESTS := $(filter-out $(if $(SANITIZE),api-dlopen api-memory),$(API_PROGRAMS:$(OUT)/tests/api/%=api-%))
.PHONY: $(API_TESTS)
$(API_TESTS): api-%: $(OUT)/tests/api/%
	$(STAGE) $(FLAVOUR)$@ $<
api: $(API_TESTS) api-coverage ## the C programs against the shared library
.PHONY: api-coverage
api-coverage:
	$(STAGE) $(FLAVOUR)$@ tests/api/coverage.sh

headers: | $(call needs,test) ## every public header alone, under each standard and both compilers
	$(STAGE) $(FLAVOUR)$@ tests/compile/headers.sh

# The export lists, and the ABI against the committed baseline. The baseline is of g++ on this kind of machine.
EXPORTS := $(LIBRARIES:%=exports-%)
.PHONY: $(EXPORTS)
$(EXPORTS): exports-%: $(foreach name,$(LIBRARIES),$(SHARED_$(name))) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ env LOCUS_MAY_NEED='$(MAY_NEED_$*)' tests/abi/exports.sh $(SHARED_$*) src/lib$*.map $(HEADERS_$*)
exports: $(EXPORTS) ## what library, version script and headers export is the same

ABIS := $(LIBRARIES:%=abi-%)
.PHONY: $(ABIS)
$(ABIS): abi-%: $(foreach name,$(LIBRARIES),$(SHARED_$(name))) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/abi/compare.sh $(SHARED_$*)
abi: $(ABIS) ## compare the ABI with tests/abi/*.abi
abi-baseline: $(foreach name,$(LIBRARIES),$(SHARED_$(name))) | $(call needs,test) ## renew tests/abi/*.abi after a meant change
	@for library in $^; do tests/abi/compare.sh --renew $$library || exit 1; done

# Valgrind: no error and no leak in the API tests, in the shortest unit tests of each area (MEMCHECK_MS milliseconds of them), and in
# MEMCHECK_RUNS, targets that other files add with $(MEMCHECK) in the recipe.
MEMCHECK_MS ?= 200
# In the API tests what is still reachable at the end counts as a leak; not after dlclose, which leaves libstdc++ in memory.
MEMCHECK := valgrind --quiet --suppressions=tests/valgrind.supp --leak-check=full --error-exitcode=99 --errors-for-leak-kinds=definite,indirect,possible
MEMCHECK_REACHABLE := --errors-for-leak-kinds=all --show-leak-kinds=all
MEMCHECK_API := $(patsubst %,memcheck-%,$(filter-out api-memory,$(API_TESTS)))
MEMCHECK_UNIT := $(UNIT_AREAS:%=memcheck-unit-%)
.PHONY: $(MEMCHECK_API) $(MEMCHECK_UNIT)
$(MEMCHECK_API): memcheck-api-%: $(OUT)/tests/api/%
	$(STAGE) $(FLAVOUR)$@ $(MEMCHECK) $(if $(filter dlopen,$*),,$(MEMCHECK_REACHABLE)) $< $(if $(filter dlopen,$*),10)
$(MEMCHECK_UNIT): memcheck-unit-%: $(OUT)/tests/unit_%
	$(STAGE) $(FLAVOUR)$@ tests/unit/memcheck.sh $< $(MEMCHECK_MS) $(MEMCHECK)
memcheck: $(MEMCHECK_API) $(MEMCHECK_UNIT) $(MEMCHECK_RUNS) ## Valgrind over the API tests, the short unit tests, a small demo

# Installation: an outside C and C++ program, by pkg-config and by CMake, shared and static; then uninstall leaves nothing.
install-test: $(foreach name,$(LIBRARIES),$(SHARED_$(name)) $(STATIC_$(name))) | $(call needs,test) ## try make install and uninstall
	+$(STAGE) $(FLAVOUR)$@ env MAKE='$(MAKE)' tests/install/run.sh

# The program in README.md.
readme: $(SHARED_locus) | $(call needs,test) ## compile and run the README's program
	$(STAGE) $(FLAVOUR)$@ tests/install/readme.sh $(OUT)
