# liblocus_io, the file formats: a library of its own, shared and static, which does not need liblocus.
IO_SOURCES := $(wildcard src/io/*.cpp)
$(eval $(call library,locus_io,$(IO_SOURCES),$(IO_HEADERS),-lzstd -lnifti2 -lznz -lz -lm,io))
MAY_NEED_locus_io := libnifti2\.so\..*|libznz\.so\..*|libz\.so\.1|libzstd\.so\.1
IO_SHARED := $(SHARED_locus_io)
IO_STATIC := $(STATIC_locus_io)
IO_LIBS := $(LIBS_locus_io)
$(OBJECTS_locus_io): EXTRA_CPPFLAGS += -isystem /usr/include/nifti

.PHONY: io
io: $(IO_SHARED) $(IO_STATIC) ## build liblocus_io.so and liblocus_io.a, which read and write files
	@echo "built $(IO_SHARED)"
