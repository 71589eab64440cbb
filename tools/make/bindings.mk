# The bindings: other languages on the C interface alone. `make check` runs their tests.
.PHONY: bindings bindings-cpp
bindings: bindings-cpp ## test the bindings to other languages
check: bindings

# The C++ types of include/locus/*.hpp; their unit tests are unit-cpp.
bindings-cpp: $(SHARED_locus) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/bindings/cpp.sh $(OUT)
