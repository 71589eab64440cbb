# The libraries, shared and static: liblocus here, others (liblocus_io, liblocus_cold) in files of their own by the same `library`.

# Undefined symbols are errors, except with clang's sanitizers, whose run-time is in the program only.
COMMA := ,
LINK_STRICT := $(if $(and $(SANITIZE),$(findstring clang,$(CXX))),,-Wl$(COMMA)-z$(COMMA)defs)

# $(eval $(call library,NAME,SOURCES,HEADERS,LIBS,JOBS,BASES)): lib<NAME>.so, which exports what src/lib<NAME>.map lists, and lib<NAME>.a.
# HEADERS: the public headers that declare its functions; LIBS: what the linker needs; JOBS: of tools/packages.txt;
# BASES: those of our libraries that it stands on.
LIBRARIES :=
define library
LIBRARIES += $(1)
HEADERS_$(1) := $(3)
LIBS_$(1) := $(4)
BASES_$(1) := $(6)
SHARED_$(1) := $(OUT)/lib$(1).so.$(VERSION)
STATIC_$(1) := $(OUT)/lib$(1).a
OBJECTS_$(1) := $(2:%=$(OUT)/%.o)
$(2:%=$(OUT)/%.o): | $(call needs,$(5))

# The links that the linker (lib<NAME>.so) and the loader (the soname) look for stand beside the library.
$(OUT)/lib$(1).so.$(VERSION): $(2:%=$(OUT)/%.o) src/lib$(1).map $(OUT)/lib$(1).sources $(foreach base,$(6),$(SHARED_$(base)))
	@echo "  LD  $$@"
	@$$(CXX) -shared -Wl,-soname,lib$(1).so.$(SOVERSION) -Wl,--version-script=src/lib$(1).map $(LINK_STRICT) \
	    -Wl,-z,relro,-z,now $$(LINK_$(1)) -Wl,--as-needed $$(filter %.o,$$^) $(if $(6),-L$(OUT) $(6:%=-l%)) $(4) $$(LDFLAGS_ALL) -o $$@
	@ln -sfn $$(@F) $(OUT)/lib$(1).so.$(SOVERSION)
	@ln -sfn lib$(1).so.$(SOVERSION) $(OUT)/lib$(1).so

$(OUT)/lib$(1).a: $(2:%=$(OUT)/%.o) $(OUT)/lib$(1).sources
	@echo "  AR  $$@"
	@rm -f $$@
	@$$(AR) rcs $$@ $$(filter %.o,$$^)

# Changes when a source file comes or goes, so that the libraries are linked anew.
$(OUT)/lib$(1).sources: FORCE
	@mkdir -p $$(@D)
	@echo '$(2)' | cmp -s - $$@ || echo '$(2)' >$$@
endef
.PHONY: FORCE
FORCE:

IO_HEADERS := $(wildcard $(addprefix include/locus/,io.h volume.h records.h))
COLD_HEADERS := $(wildcard include/locus/cold.h)
LIB_SOURCES := $(wildcard src/core/*.cpp src/capi/*.cpp src/graph/*.cpp src/graph/*/*.cpp src/pmq/*.cpp src/pmq/*/*.cpp)
$(eval $(call library,locus,$(LIB_SOURCES),$(filter-out $(IO_HEADERS) $(COLD_HEADERS),$(wildcard include/locus/*.h)),,))
# liblocus_cuda.so is looked for beside it too.
LINK_locus = -Wl,-rpath,'$$ORIGIN'
LIB_SHARED := $(SHARED_locus)
LIB_STATIC := $(STATIC_locus)

.PHONY: lib
lib: $(LIB_SHARED) $(LIB_STATIC) ## build liblocus.so and liblocus.a
	@ln -sfn $(notdir $(OUT)) build/latest
	@echo "built $(LIB_SHARED)"

# abidiff reads the types of the interface from what the sources that export it say of them.
INTERFACE := $(wildcard src/capi/*.cpp) $(addprefix src/io/,error.cpp records.cpp volume.cpp) src/cold/cold.cpp
$(INTERFACE:%=$(OUT)/%.o): private EXTRA_CXXFLAGS += -g

# Undefined behaviour in the SIMD kernels is looked for in their scalar build, of the same source: for all vector targets at once
# g++ takes minutes over it.
$(OUT)/src/%_simd.cpp.o: private EXTRA_CXXFLAGS += $(if $(filter address,$(SANITIZE)),-fno-sanitize=undefined)
