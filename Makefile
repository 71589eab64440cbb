# Locus. `make help` lists the targets; tools/make/ holds the rules, one file per job.
.DEFAULT_GOAL := lib
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules
# As many jobs as cores, unless the command line says how many. While make reads this file it does not show its own -j in MAKEFLAGS
# yet, so ask the kernel; a make within make takes part in the jobs of the outer one.
ifeq ($(MAKELEVEL),0)
ifeq ($(filter -j% --jobs%,$(shell tr '\0' '\n' <"/proc/$$PPID/cmdline" 2>/dev/null)),)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 2)
endif
endif

include tools/make/config.mk
include tools/make/lib.mk
include tools/make/io.mk
include tools/make/cold.mk
include tools/make/demo.mk
include tools/make/test.mk
include tools/make/check.mk
include tools/make/browser.mk
include tools/make/docs.mk
include tools/make/bench.mk
include tools/make/bindings.mk
include tools/make/cuda.mk
include tools/make/install.mk

.PHONY: help clean format
help: ## list the targets
	@echo "make TARGET [VARIABLE=value]"
	@grep -hE '^[a-z-]+:.*## ' Makefile tools/make/*.mk | sed -E 's/:.*## /\t/' | sort | awk -F'\t' '{printf "  %-14s %s\n", $$1, $$2}'
	@echo "Variables: CXX=clang++ SIMD=scalar SANITIZE=address|thread MODE=debug PREFIX=/usr/local DESTDIR= ONLY=regex QUICK=1 LOCUS_DATA=folder SKIP_PACKAGES=1"

clean: ## remove everything that was built
	rm -rf build

format: ## format the sources with clang-format
	git ls-files '*.c' '*.h' '*.cpp' '*.hpp' '*.cu' '*.cuh' | xargs clang-format -i

# Header dependencies of what this set of flags has compiled so far.
-include $(shell test -d $(OUT) && find $(OUT) -name '*.d')
