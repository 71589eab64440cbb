# liblocus_io, the file formats: a library of its own, shared and static, which does not need liblocus.
IO_SOURCES := $(wildcard src/io/*.cpp)
IO_OBJECTS := $(IO_SOURCES:%=$(OUT)/%.o)
IO_SONAME := liblocus_io.so.$(SOVERSION)
IO_SHARED := $(OUT)/liblocus_io.so.$(VERSION)
IO_STATIC := $(OUT)/liblocus_io.a
IO_LIBS := -lnifti2 -lznz -lz -lm

.PHONY: io
io: $(IO_SHARED) $(IO_STATIC) ## build liblocus_io.so and liblocus_io.a, which read and write files
	@echo "built $(IO_SHARED)"

$(IO_OBJECTS): EXTRA_CPPFLAGS += -isystem /usr/include/nifti
$(IO_OBJECTS): | $(if $(SKIP_PACKAGES),,packages-io)

$(IO_SHARED): $(IO_OBJECTS) src/liblocus_io.map
	@echo "  LD  $@"
	@$(CXX) -shared -Wl,-soname,$(IO_SONAME) -Wl,--version-script=src/liblocus_io.map -Wl,-z,defs -Wl,-z,relro,-z,now \
	    $(IO_OBJECTS) -Wl,--as-needed $(IO_LIBS) $(LDFLAGS_ALL) -o $@
	@ln -sfn $(notdir $@) $(OUT)/$(IO_SONAME)
	@ln -sfn $(IO_SONAME) $(OUT)/liblocus_io.so

$(IO_STATIC): $(IO_OBJECTS)
	@echo "  AR  $@"
	@rm -f $@
	@$(AR) rcs $@ $^

# The unit tests of src/io link it too.
$(OUT)/tests/unit_io: $(IO_STATIC)
UNIT_LIBS_io = $(IO_LIBS)
