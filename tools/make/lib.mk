# The main library, shared and static.
LIB_SOURCES := $(wildcard src/core/*.cpp src/capi/*.cpp src/graph/*.cpp src/graph/*/*.cpp src/pmq/*.cpp src/pmq/*/*.cpp)
LIB_OBJECTS := $(LIB_SOURCES:%=$(OUT)/%.o)
LIB_SONAME := liblocus.so.$(SOVERSION)
LIB_SHARED := $(OUT)/liblocus.so.$(VERSION)
LIB_STATIC := $(OUT)/liblocus.a

.PHONY: lib
lib: $(LIB_SHARED) $(LIB_STATIC) ## build liblocus.so and liblocus.a
	@ln -sfn $(notdir $(OUT)) build/latest
	@echo "built $(LIB_SHARED)"

# The links that the linker (liblocus.so) and the loader (the soname) look for stand beside the library.
$(LIB_SHARED): $(LIB_OBJECTS) src/liblocus.map
	@echo "  LD  $@"
	@$(CXX) -shared -Wl,-soname,$(LIB_SONAME) -Wl,--version-script=src/liblocus.map -Wl,-z,defs -Wl,-z,relro,-z,now \
	    $(LIB_OBJECTS) $(LDFLAGS_ALL) -o $@
	@ln -sfn $(notdir $@) $(OUT)/$(LIB_SONAME)
	@ln -sfn $(LIB_SONAME) $(OUT)/liblocus.so

$(LIB_STATIC): $(LIB_OBJECTS)
	@echo "  AR  $@"
	@rm -f $@
	@$(AR) rcs $@ $^
