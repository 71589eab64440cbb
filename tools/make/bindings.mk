# The bindings: other languages on the C interface alone. `make check` runs their tests.
.PHONY: bindings bindings-cpp bindings-node bindings-python bindings-rust bindings-coverage tour-node tutorial-python
bindings: bindings-cpp bindings-node bindings-python bindings-rust bindings-coverage ## test the bindings to other languages
check: bindings

# Where the packages find the libraries.
LIBRARIES_HERE = LOCUS_LIBRARY=$(abspath $(SHARED_locus)) LOCUS_IO_LIBRARY=$(abspath $(SHARED_locus_io)) LOCUS_COLD_LIBRARY=$(abspath $(SHARED_locus_cold))

# The C++ types of include/locus/*.hpp; their unit tests are unit-cpp.
bindings-cpp: $(SHARED_locus) $(SHARED_locus_cold) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/bindings/cpp.sh $(OUT)

# The Node.js package: koffi, and the compiler that checks the types, from npm at the versions of the lock file.
NODE_MODULES := bindings/node/node_modules/.package-lock.json
$(NODE_MODULES): bindings/node/package-lock.json | $(call needs,bindings)
	@npm ci --prefix bindings/node --ignore-scripts --no-audit --no-fund --silent
	@touch $@
bindings-node: $(SHARED_locus) $(SHARED_locus_io) $(SHARED_locus_cold) $(NODE_MODULES) | $(call needs,test bindings)
	$(STAGE) $(FLAVOUR)$@ env $(LIBRARIES_HERE) tests/bindings/node.sh $(OUT)/node
tour-node: $(SHARED_locus) $(SHARED_locus_io) $(NODE_MODULES) | $(call needs,bindings) ## tour both engines from Node.js, with a heat map in build/tour.png
	@env $(LIBRARIES_HERE) node bindings/node/examples/tour.js build/tour.png

# The Python package: its tests, its layout of structs, pip install into a scratch folder. PYTHON is Debian's, which has numpy and cffi.
PYTHON ?= /usr/bin/python3
PYTHON_HERE = $(LIBRARIES_HERE) PYTHONDONTWRITEBYTECODE=1 PYTHON=$(PYTHON)
bindings-python: $(SHARED_locus) $(SHARED_locus_io) $(SHARED_locus_cold) | $(call needs,test bindings)
	$(STAGE) $(FLAVOUR)$@ env $(PYTHON_HERE) tests/bindings/python.sh
tutorial-python: $(SHARED_locus) $(SHARED_locus_io) $(HEAD_CT) | $(call needs,bindings) ## draw a head CT and a stream from Python into build/tutorial
	@env $(PYTHON_HERE) PYTHONPATH=bindings/python $(PYTHON) bindings/python/tutorial/tutorial.py $(HEAD_CT) build/tutorial

# The Rust crates: tests, doctests, layout of structs, the tour.
bindings-rust: $(SHARED_locus) $(SHARED_locus_cold) | $(call needs,test)
	@if command -v cargo >/dev/null; \
	then $(STAGE:@%=%) $(FLAVOUR)$@ tests/bindings/rust.sh $(abspath $(dir $(SHARED_locus))) $(abspath $(OUT))/rust; \
	else echo "bindings-rust: skipped, there is no cargo"; fi

# Every exported function is bound or left out with a reason, in each binding; and C++ sees the structs as C does.
bindings-coverage: | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ sh -c 'tests/bindings/coverage.sh && tests/bindings/layout.sh'
