# Rules of the demo targets: the example programs, which see the public headers and the shared libraries only.
DEMO_OUT ?= build/demo
EXAMPLE_COMMON := $(patsubst %,$(OUT)/%.o,$(wildcard examples/common/*.cpp))
# private: not for the libraries, which the programs have as prerequisites.
$(OUT)/examples/%: private CPPFLAGS_ALL := -Iinclude -Iexamples $(CPPFLAGS)
# g++ 12 sees overlapping copies in joined strings where there are none (its bug 105651).
$(OUT)/examples/%: private EXTRA_CXXFLAGS += $(if $(findstring clang,$(CXX)),,-Wno-restrict) $(QUICKLY)

# $(eval $(call example,NAME,LIBS)): $(OUT)/bin/NAME from examples/NAME/*.cpp and what the examples share; LIBS: more it needs.
define example
EXAMPLE_$(1) := $(OUT)/bin/$(1)
OBJECTS_example_$(1) := $(patsubst %,$(OUT)/%.o,$(wildcard examples/$(1)/*.cpp))
$$(OBJECTS_example_$(1)) $(EXAMPLE_COMMON): | $(call needs,demo)
$(OUT)/bin/$(1): $$(OBJECTS_example_$(1)) $(EXAMPLE_COMMON) $(SHARED_locus) $(SHARED_locus_io)
	@mkdir -p $$(@D)
	@echo "  LD  $$@"
	@$$(CXX) $$(filter %.o,$$^) -L$(OUT) -llocus_io -llocus $(2) -lpng -lz -Wl,-rpath,'$$$$ORIGIN/..' $$(LDFLAGS_ALL) -o $$@
endef

.PHONY: demo
demo: ## build the example programs and run them: pictures and results under build/demo

# The stream of posts.
$(eval $(call example,stream,-llocus_cold))
$(EXAMPLE_stream): $(SHARED_locus_cold)
.PHONY: demo-stream test-stream memcheck-stream
demo-stream: $(EXAMPLE_stream) ## a day of posts through a six-hour window of the PMQ store
	@$(EXAMPLE_stream) --keep --out $(DEMO_OUT)/stream $(STREAM_FLAGS)
demo: demo-stream

test-stream: $(EXAMPLE_stream) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/examples/stream.sh $<
test: test-stream
memcheck-stream: $(EXAMPLE_stream) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ $(MEMCHECK) $< --posts 2000 --frames 1 --keep --out $(OUT)/memcheck-stream
MEMCHECK_RUNS += memcheck-stream

# The explorer: a server on the stream. Its page needs no building. Debian's cpp-httplib is compiled with these features.
$(eval $(call example,explorer,-llocus_cold -lcpp-httplib))
$(EXAMPLE_explorer): $(SHARED_locus_cold)
$(OBJECTS_example_explorer): | $(call needs,explorer)
HTTPLIB_OBJECTS := $(patsubst %,$(OUT)/examples/explorer/%.cpp.o,server connection)
$(HTTPLIB_OBJECTS): private CPPFLAGS_ALL += $(addprefix -DCPPHTTPLIB_,$(addsuffix _SUPPORT,OPENSSL ZLIB BROTLI))
.PHONY: explorer explorer-program check-explorer
explorer-program: $(EXAMPLE_explorer)
check-explorer: $(EXAMPLE_explorer) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ /usr/bin/python3 tests/examples/explorer.py $(abspath $<)
check: check-explorer
explorer: $(EXAMPLE_explorer) ## build the explorer and serve the demo stream at http://127.0.0.1:8080; EXPLORER_FLAGS: see its --help
	@$(EXAMPLE_explorer) $(EXPLORER_FLAGS)

# Unit tests of the examples' own parts.
UNIT_LIBS_examples := -lpng -lz
$(patsubst %,$(OUT)/%.o,$(wildcard tests/unit/examples/*.cpp)): EXTRA_CPPFLAGS += -Iexamples
$(OUT)/tests/unit_examples: $(EXAMPLE_COMMON) $(filter-out %/main.cpp.o,$(OBJECTS_example_stream)) $(OUT)/examples/explorer/renewer.cpp.o

# Volumes: a head CT out of InVesalius' compressed tar, and the steak where its data are.
$(eval $(call example,volume))
VOLUME_OUT := $(DEMO_OUT)/volume
CRANIUM := /usr/share/doc/invesalius-examples/examples/Cranium.inv3
HEAD_CT := $(VOLUME_OUT)/head-ct.raw
# Some systems install no documentation: then the archive comes out of the package itself.
$(HEAD_CT): | $(call needs,demo)
	@mkdir -p $(@D)
	@if [ -r $(CRANIUM) ]; then cp $(CRANIUM) $@.tar; else cd $(@D) && apt-get download -q invesalius-examples && \
	    dpkg-deb --fsys-tarfile invesalius-examples_*.deb | tar -xO .$(CRANIUM) >$(@F).tar; fi
	@tar -xOf $@.tar --wildcards '*/matrix.dat' >$@.part
	@rm -f $@.tar
	@mv $@.part $@

.PHONY: demo-volume demo-head demo-steak
demo-volume: demo-head demo-steak
# What its main.plist says of the matrix; its rows run from back to front.
demo-head: $(EXAMPLE_volume) $(HEAD_CT) ## Voronoi cells of 32 seeds in a head CT, and a cut through it
	@$(EXAMPLE_volume) $(HEAD_CT) --raw 256 256 108 --raw-type int16 --raw-spacing 0.9570312 0.9570312 1.5 --flip y \
	    --table examples/volume/head.table --largest-part --place 32 --lloyd 5 --title 'Head CT' --anatomy --window -250 1200 --cut 100.5 256 -1  100.5 110 -1  100.5 256 108 \
	    --out $(VOLUME_OUT)/head
demo-steak: $(EXAMPLE_volume) ## Voronoi cells, waves, weights, a cut and a deformation of a T-bone steak, where LOCUS_DATA holds it
	@if [ -r $(LOCUS_DATA)/steak/steak_64x64x15.mhd ]; then \
	    $(EXAMPLE_volume) $(LOCUS_DATA)/steak/steak_64x64x15.mhd --table examples/volume/steak.table \
	        --seeds $(LOCUS_DATA)/steak/seeds_10.txt --title 'T-bone steak' --waves --out $(VOLUME_OUT)/steak && \
	    $(EXAMPLE_volume) $(LOCUS_DATA)/steak/steak_64x64x15.mhd --table examples/volume/steak.table --no-trace --weights \
	        --seeds $(LOCUS_DATA)/steak/seeds_3.txt --title 'T-bone steak' --out $(VOLUME_OUT)/steak-frames \
	        --deform 2 -1.2 -0.6 -25 --cut 33.5 -1 -1  33.5 26.5 -1  33.5 -1 15; \
	else echo "demo-steak: skipped, there is no $(LOCUS_DATA)/steak (set LOCUS_DATA)"; fi
demo: demo-volume

$(OUT)/tests/unit_examples: $(filter-out %/main.cpp.o,$(OBJECTS_example_volume))

# The program from end to end on a small volume, under Valgrind.
MEMCHECK_RUNS += memcheck-volume
.PHONY: memcheck-volume
memcheck-volume: $(EXAMPLE_volume) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ env RUN='$(MEMCHECK)' tests/examples/volume.sh $(EXAMPLE_volume)

# One after the other, for the sake of what they print.
demo-steak: | demo-head
ifneq ($(filter demo,$(MAKECMDGOALS)),)
demo-head: | demo-stream
endif
