# Compilers, flags and folders. Objects live in a folder per set of flags, so switching flags never mixes objects.
ifeq ($(origin CXX),default)
CXX := g++
endif
ifeq ($(origin CC),default)
CC := $(if $(findstring clang,$(CXX)),$(subst clang++,clang,$(CXX)),gcc)
endif
ifeq ($(origin AR),default)
AR := ar
endif
SIMD ?= highway
MODE ?= release
SANITIZE ?=
LOCUS_DATA ?= ../shared/data
export LOCUS_DATA

VERSION := $(shell awk '/define LOCUS_VERSION_(MAJOR|MINOR|PATCH)/ {v = v s $$3; s = "."} END {print v}' include/locus/status.h)
SOVERSION := $(firstword $(subst ., ,$(VERSION)))

WARN := -Wall -Wextra -Wpedantic -Wconversion -Werror
# Under the sanitizers g++ (not clang) warns of what cannot happen; the same sources are held to -Werror without them.
ifneq ($(and $(SANITIZE),$(findstring g++,$(filter-out clang++,$(notdir $(CXX))))),)
WARN := $(filter-out -Werror,$(WARN))
endif
CPPFLAGS_ALL := -Iinclude -Isrc $(CPPFLAGS)
# Lines of the sources are enough for backtraces and reports: variables take a quarter of the time of compiling.
DEBUG_INFO := $(if $(filter debug,$(MODE)),-g,-g1)
# -ffile-prefix-map: no path of the build machine in what is installed. Unique symbols (a GNU extension) would pin the library
# in memory after dlclose. -ffp-contract=off: a fused multiply-add would give other edge weights than separate ones.
CXXFLAGS_ALL := -std=c++20 $(DEBUG_INFO) -fPIC -pthread -fvisibility=hidden -fvisibility-inlines-hidden -ffp-contract=off \
    -ffile-prefix-map=$(CURDIR)/= $(if $(findstring clang,$(CXX)),,-fno-gnu-unique) $(WARN) $(CXXFLAGS)
CFLAGS_ALL := -std=c11 $(DEBUG_INFO) -pthread -ffile-prefix-map=$(CURDIR)/= $(WARN) $(CFLAGS)
LDFLAGS_ALL := -pthread $(LDFLAGS)
ifeq ($(MODE),debug)
CXXFLAGS_ALL += -O0
CFLAGS_ALL += -O0
else ifeq ($(MODE),release)
CXXFLAGS_ALL += $(if $(SANITIZE),-O1,-O3)
CFLAGS_ALL += $(if $(SANITIZE),-O1,-O2)
else
$(error MODE=$(MODE): only 'release' (the default) and 'debug' are known)
endif
# Flags that halve the time of compiling: for tests, and for what takes little of a program's time.
QUICKLY := $(if $(filter release,$(MODE)),-O1)
ifeq ($(SIMD),scalar)
CPPFLAGS_ALL += -DLOCUS_SIMD_SCALAR_ONLY
else ifneq ($(SIMD),highway)
$(error SIMD=$(SIMD): only 'highway' (the default) and 'scalar' are known)
endif
ifeq ($(SANITIZE),address)
SANITIZER := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
else ifeq ($(SANITIZE),thread)
SANITIZER := -fsanitize=thread -fno-omit-frame-pointer
else ifeq ($(SANITIZE),fuzzer)
SANITIZER := -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
else ifneq ($(SANITIZE),)
$(error SANITIZE=$(SANITIZE): only 'address', 'thread' and 'fuzzer' are known)
endif
CXXFLAGS_ALL += $(SANITIZER)
CFLAGS_ALL += $(SANITIZER)
LDFLAGS_ALL += $(SANITIZER)

# build/<flags>/ holds the objects, libraries and programs of one set of flags; build/latest points at that of the last `make lib`.
FLAGS_ID := $(shell printf '%s' '$(CXX) $(CC) $(CPPFLAGS_ALL) $(CXXFLAGS_ALL) $(CFLAGS_ALL) $(LDFLAGS_ALL)' | cksum | cut -d' ' -f1)
OUT := build/$(notdir $(CXX))-$(MODE)$(addprefix -,$(SANITIZE))$(if $(filter scalar,$(SIMD)),-scalar)-$(FLAGS_ID)

# Objects wait for `packages-JOB`, which looks once per run of make that the packages of a job are there (tools/packages.txt).
# $(call needs,JOB...) is the order-only prerequisite for that. SIMD=scalar needs no package for the library.
needs = $(if $(SKIP_PACKAGES),,$(1:%=packages-%))
BUILD_PACKAGES := $(if $(filter scalar,$(SIMD)),,$(call needs,build))
packages-%:
	@tools/packages.sh $*

# Flags of one object: set EXTRA_CPPFLAGS or EXTRA_CXXFLAGS for the object itself; for a program they would reach the library's objects.
$(OUT)/%.cpp.o: %.cpp | $(BUILD_PACKAGES)
	@mkdir -p $(@D)
	@echo "  CXX $<"
	@$(CXX) $(CPPFLAGS_ALL) $(EXTRA_CPPFLAGS) $(CXXFLAGS_ALL) $(EXTRA_CXXFLAGS) -MMD -MP -c $< -o $@

$(OUT)/%.c.o: %.c | $(BUILD_PACKAGES)
	@mkdir -p $(@D)
	@echo "  CC  $<"
	@$(CC) $(CPPFLAGS_ALL) $(EXTRA_CPPFLAGS) $(CFLAGS_ALL) -MMD -MP -c $< -o $@
