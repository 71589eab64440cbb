# Rules of the demo targets: the example programs, which see the public headers and the shared libraries only.
DEMO_OUT ?= build/demo
EXAMPLE_COMMON := $(patsubst %,$(OUT)/%.o,$(wildcard examples/common/*.cpp))
$(OUT)/examples/%: CPPFLAGS_ALL := -Iinclude -Iexamples $(CPPFLAGS)
