# Compilers, flags and folders. Objects live in a folder per set of flags, so switching flags never mixes objects.
CXX ?= g++
CC ?= gcc
ifeq ($(origin CXX),default)
CXX := g++
endif
ifeq ($(origin CC),default)
CC := gcc
endif
AR ?= ar
SIMD ?= highway
MODE ?= release
SANITIZE ?=
LOCUS_DATA ?= ../shared/data
export LOCUS_DATA

VERSION := $(shell awk '/define LOCUS_VERSION_(MAJOR|MINOR|PATCH)/ {v = v s $$3; s = "."} END {print v}' include/locus/status.h)
SOVERSION := $(firstword $(subst ., ,$(VERSION)))

WARN := -Wall -Wextra -Wpedantic -Wconversion -Werror
CPPFLAGS_ALL := -Iinclude -Isrc $(CPPFLAGS)
CXXFLAGS_ALL := -std=c++20 -g -fPIC -pthread -fvisibility=hidden -fvisibility-inlines-hidden $(WARN) $(CXXFLAGS)
CFLAGS_ALL := -std=c11 -g -pthread $(WARN) $(CFLAGS)
LDFLAGS_ALL := -pthread $(LDFLAGS)
ifeq ($(MODE),debug)
CXXFLAGS_ALL += -O0
CFLAGS_ALL += -O0
else
CXXFLAGS_ALL += -O3
CFLAGS_ALL += -O2
endif
ifeq ($(SIMD),scalar)
CPPFLAGS_ALL += -DLOCUS_SIMD_SCALAR_ONLY
else ifneq ($(SIMD),highway)
$(error SIMD=$(SIMD): only 'highway' (the default) and 'scalar' are known)
endif
ifeq ($(SANITIZE),address)
SANITIZER := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
else ifeq ($(SANITIZE),thread)
SANITIZER := -fsanitize=thread -fno-omit-frame-pointer
else ifneq ($(SANITIZE),)
$(error SANITIZE=$(SANITIZE): only 'address' and 'thread' are known)
endif
CXXFLAGS_ALL += $(SANITIZER)
CFLAGS_ALL += $(SANITIZER)
LDFLAGS_ALL += $(SANITIZER)

# build/<flags>/ holds objects, libraries and programs of one set of flags; build/lib and build/bin point at the latest.
FLAGS_ID := $(shell printf '%s' '$(CXX) $(CC) $(CPPFLAGS_ALL) $(CXXFLAGS_ALL) $(CFLAGS_ALL) $(LDFLAGS_ALL)' | cksum | cut -d' ' -f1)
OUT := build/$(notdir $(CXX))-$(MODE)$(addprefix -,$(SANITIZE))$(if $(filter scalar,$(SIMD)),-scalar)-$(FLAGS_ID)

# $(call packages,JOB...) as a recipe line: make sure of the packages of these jobs.
packages = @$(if $(SKIP_PACKAGES),:,tools/packages.sh $(1))
# A phony prerequisite per job: packages-build, packages-test, ...
packages-%:
	$(call packages,$*)

$(OUT)/%.cpp.o: %.cpp | $(if $(SKIP_PACKAGES),,packages-build)
	@mkdir -p $(@D)
	@echo "  CXX $<"
	@$(CXX) $(CPPFLAGS_ALL) $(EXTRA_CPPFLAGS) $(CXXFLAGS_ALL) $(EXTRA_CXXFLAGS) -MMD -MP -c $< -o $@

$(OUT)/%.c.o: %.c | $(if $(SKIP_PACKAGES),,packages-build)
	@mkdir -p $(@D)
	@echo "  CC $<"
	@$(CC) $(CPPFLAGS_ALL) $(EXTRA_CPPFLAGS) $(CFLAGS_ALL) -MMD -MP -c $< -o $@
