# The CUDA backend: liblocus_cuda.so, which liblocus opens at run time, and the emulated device that the tests run its kernels on.

# The emulated device: kernel bodies on the host, for tests only.
EMULATED_OBJECTS := $(OUT)/tests/emulated/device.cpp.o
$(OUT)/tests/emulated/%.cpp.o: EXTRA_CPPFLAGS += -I.
$(OUT)/tests/unit_cuda: $(EMULATED_OBJECTS)
