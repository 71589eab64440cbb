# Locus. `make help` lists the targets; tools/make/ holds the rules, one file per job.
.DEFAULT_GOAL := lib
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules
ifeq ($(filter -j%,$(MAKEFLAGS)),)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 2)
endif

include tools/make/config.mk
include tools/make/lib.mk
include tools/make/io.mk
include tools/make/demo.mk
include tools/make/test.mk
include tools/make/check.mk
include tools/make/bench.mk
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
