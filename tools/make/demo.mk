# Rules of the demo targets: the example programs, which see the public headers and the shared libraries only.
DEMO_OUT ?= build/demo
EXAMPLE_COMMON := $(patsubst %,$(OUT)/%.o,$(wildcard examples/common/*.cpp))
# private: not for the libraries, which the programs have as prerequisites.
$(OUT)/examples/%: private CPPFLAGS_ALL := -Iinclude -Iexamples $(CPPFLAGS)

# $(eval $(call example,NAME,LIBS)): $(OUT)/bin/NAME from examples/NAME/*.cpp and what the examples share.
define example
EXAMPLE_$(1) := $(OUT)/bin/$(1)
OBJECTS_example_$(1) := $(patsubst %,$(OUT)/%.o,$(wildcard examples/$(1)/*.cpp))
$$(OBJECTS_example_$(1)) $(EXAMPLE_COMMON): | $(call needs,demo)
$(OUT)/bin/$(1): $$(OBJECTS_example_$(1)) $(EXAMPLE_COMMON) $(SHARED_locus) $(SHARED_locus_io)
	@mkdir -p $$(@D)
	@echo "  LD  $$@"
	@$$(CXX) $$(filter %.o,$$^) -L$(OUT) -llocus_io -llocus $(2) -lpng -Wl,-rpath,'$$$$ORIGIN/..' $$(LDFLAGS_ALL) -o $$@
endef

.PHONY: demo
demo: ## build the example programs and run them: pictures and results under build/demo

# The stream of posts.
$(eval $(call example,stream,-lz))
.PHONY: demo-stream test-stream memcheck-stream
demo-stream: $(EXAMPLE_stream) ## a day of posts through a six-hour window of the PMQ store
	@$(EXAMPLE_stream) --out $(DEMO_OUT)/stream $(STREAM_FLAGS)
demo: demo-stream

test-stream: $(EXAMPLE_stream) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/examples/stream.sh $<
test: test-stream
memcheck-stream: $(EXAMPLE_stream) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ $(MEMCHECK) $< --posts 2000 --frames 1 --out $(OUT)/memcheck-stream
MEMCHECK_RUNS += memcheck-stream

# Unit tests of the examples' own parts.
UNIT_LIBS_examples := -lpng -lz
$(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/examples/*.cpp)): EXTRA_CPPFLAGS += -Iexamples
$(OUT)/tests/unit_examples: $(EXAMPLE_COMMON) $(filter-out %/main.cpp.o,$(OBJECTS_example_stream))
