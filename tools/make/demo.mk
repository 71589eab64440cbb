# Rules of the demo targets: the example programs, which see the public headers and the shared libraries only.
DEMO_OUT ?= build/demo
EXAMPLE_COMMON := $(patsubst %,$(OUT)/%.o,$(wildcard examples/common/*.cpp))
# private: not for the libraries, which the programs have as prerequisites.
$(OUT)/examples/%: private CPPFLAGS_ALL := -Iinclude -Iexamples $(CPPFLAGS)
