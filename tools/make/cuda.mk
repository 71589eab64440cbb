# The CUDA backend: liblocus_cuda.so, which liblocus opens at run time. It is built where nvcc is found, unless CUDA=no; only nvcc sees
# CUDA's headers. NVCC_ARCH: machine code for these GPUs, and PTX for newer ones.
CUDA ?= $(if $(SANITIZE),no,yes)
ifeq ($(origin NVCC),undefined)
NVCC := $(if $(filter yes,$(CUDA)),$(firstword $(shell command -v nvcc 2>/dev/null) $(wildcard /usr/local/cuda/bin/nvcc)))
endif
NVCC_ARCH ?= -gencode arch=compute_80,code=sm_80 -gencode arch=compute_90,code=[sm_90,compute_90]
# -fmad=false: a fused multiply-add would give other edge weights than the CPU's separate ones.
NVCC_FLAGS := -std=c++20 -O3 -Iinclude -Isrc -I. -fmad=false --expt-relaxed-constexpr \
    -Xcompiler -fPIC,-fvisibility=hidden,-Wall $(NVCC_ARCH)
# nvcc takes minutes over all kernels: through ccache where it is there.
CCACHE := $(shell command -v ccache 2>/dev/null)
CUDA_SOURCES := $(wildcard cuda/*.cu)
CUDA_OBJECTS := $(CUDA_SOURCES:%=$(OUT)/%.o)
SHARED_CUDA := $(OUT)/liblocus_cuda.so.$(VERSION)

# What each kernel needs stands in the .ptxas file beside its object.
$(OUT)/%.cu.o: %.cu
	@mkdir -p $(@D)
	@echo "  NVCC $<"
	@$(CCACHE) $(NVCC) $(NVCC_FLAGS) -Xptxas -v -MMD -MP -MF $(@:.o=.d) -MT $@ -c $< -o $@ 2>$(@:.o=.ptxas) || { cat $(@:.o=.ptxas); exit 1; }

$(SHARED_CUDA): $(CUDA_OBJECTS) cuda/liblocus_cuda.map
	@echo "  LD  $@"
	@$(NVCC) -shared -cudart static $(CUDA_OBJECTS) -o $@ $(NVCC_ARCH) -Xlinker -soname,liblocus_cuda.so.$(SOVERSION),--version-script=cuda/liblocus_cuda.map
	@ln -sfn $(@F) $(OUT)/liblocus_cuda.so.$(SOVERSION)

.PHONY: cuda cuda-table
cuda: $(if $(NVCC),$(SHARED_CUDA)) ## build liblocus_cuda.so, the CUDA backend
	@$(if $(NVCC),echo "built $(SHARED_CUDA)",echo "cuda: there is no nvcc"; exit 1)
lib: $(if $(NVCC),$(SHARED_CUDA))
cuda-table: $(if $(NVCC),$(CUDA_OBJECTS)) ## registers, shared memory and spills of every kernel, from the compiler's report
	@tools/ptxas_table.sh $(CUDA_OBJECTS:.o=.ptxas)

# What locus_version_text says.
$(OUT)/src/capi/status.cpp.o: EXTRA_CPPFLAGS += $(if $(NVCC),-DLOCUS_WITH_CUDA)
$(OUT)/src/capi/status.cpp.o: $(OUT)/cuda.found
$(OUT)/cuda.found: FORCE
	@mkdir -p $(@D)
	@echo '$(NVCC)' | cmp -s - $@ || echo '$(NVCC)' >$@

# The emulated device: kernel bodies on the host, for tests only; as a library it takes the place of liblocus_cuda.so. A driver that is
# none stands beside it, and in a folder of its own a library that is not of this build.
EMULATED := $(OUT)/tests/emulated
$(OUT)/tests/emulated/%.cpp.o: EXTRA_CPPFLAGS += -I.
# g++ 12 sees places of voxels that are used before they are set, through branches that exclude each other.
$(OUT)/tests/emulated/%.cpp.o: EXTRA_CXXFLAGS += $(if $(findstring clang,$(CXX)),,-Wno-maybe-uninitialized)
$(OUT)/tests/unit_cuda: $(EMULATED)/device.cpp.o
$(EMULATED)/liblocus_cuda.so.$(SOVERSION): $(EMULATED)/device.cpp.o $(EMULATED)/entry.cpp.o $(EMULATED)/libcuda.so.1
	@$(CXX) -shared $(filter %.o,$^) $(LINK_STRICT) $(LDFLAGS_ALL) -o $@
$(OUT)/tests/%/libcuda.so.1:
	@mkdir -p $(@D)
	@$(CC) -shared -xc /dev/null -o $@
$(OUT)/tests/stale/liblocus_cuda.so.$(SOVERSION): $(OUT)/tests/stale/libcuda.so.1
	@cp $< $@

.PHONY: api-cuda-emulated api-cuda-stale api-cuda-failing api-cuda-keeping api-cuda-stream
api-cuda-emulated: $(OUT)/tests/api/cuda $(EMULATED)/liblocus_cuda.so.$(SOVERSION)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(EMULATED) $< 24 GPU
api-cuda-stale: $(OUT)/tests/api/cuda $(OUT)/tests/stale/liblocus_cuda.so.$(SOVERSION)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(OUT)/tests/stale $< 1 'of another version than liblocus'
api-cuda-failing: $(OUT)/tests/api/cuda $(EMULATED)/liblocus_cuda.so.$(SOVERSION)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(EMULATED) EMULATED_CALLS=40 $< 1 fails
api-cuda-keeping: $(OUT)/tests/api/cuda $(EMULATED)/liblocus_cuda.so.$(SOVERSION)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(EMULATED) bash -c 'for calls in {64..220..4}; do EMULATED_CALLS=$$calls $< 1 keeps || exit 1; done'
api-cuda-stream: $(OUT)/tests/api/cuda $(EMULATED)/liblocus_cuda.so.$(SOVERSION)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(EMULATED) EMULATED_STREAM=2 $< 6 stream
api: api-cuda-emulated api-cuda-stale api-cuda-failing api-cuda-keeping api-cuda-stream

# The library itself, as far as it goes without a GPU: what it exports, needs and holds; with a driver that is none it says so in CUDA's
# words; and what its kernels compute with.
.PHONY: exports-cuda api-cuda-driverless check-ptx
exports-cuda: $(SHARED_CUDA) | $(call needs,test)
	$(STAGE) $(FLAVOUR)$@ tests/abi/cuda.py $< $(VERSION)
api-cuda-driverless: $(OUT)/tests/api/cuda $(OUT)/tests/driver/libcuda.so.1 $(SHARED_CUDA)
	$(STAGE) $(FLAVOUR)$@ env LD_LIBRARY_PATH=$(OUT)/tests/driver $< 1 'cudaGetDeviceCount: '
PTX := $(patsubst cuda/%.cu,$(OUT)/cuda/%.ptx,$(filter-out cuda/library.cu cuda/compact.cu,$(CUDA_SOURCES)))
$(OUT)/cuda/%.ptx: cuda/%.cu $(OUT)/cuda/%.cu.o
	@echo "  PTX $<"
	@$(NVCC) $(filter-out $(NVCC_ARCH),$(NVCC_FLAGS)) -arch=compute_90 -ptx $< -o $@
check-ptx: $(PTX)
	$(STAGE) $@ tests/abi/ptx.sh $^
ifneq ($(NVCC),)
exports: exports-cuda
api: api-cuda-driverless
check: check-ptx
endif

# One command for a machine with nvcc, g++ and a GPU, but no packages and no network. Without a GPU it runs what needs none.
.PHONY: gpu-check gpu-check-here cuda-count
gpu-check: ## with nvcc, g++ and a GPU alone: build, test against the heap engine, compute-sanitizer, benchmarks, write tests/bench/results
	@$(if $(NVCC),true,echo "gpu-check: there is no nvcc (PATH, /usr/local/cuda/bin, NVCC=)" >&2; exit 1)
	@+$(MAKE) --no-print-directory SIMD=scalar SKIP_PACKAGES=1 gpu-check-here
# The program of tests/api with liblocus alone: the other libraries need packages.
$(OUT)/tests/gpu/cuda: tests/api/cuda.c tests/api/check.h tests/api/device_memory.h $(SHARED_locus)
	@mkdir -p $(@D)
	@echo "  CC  $<"
	@$(CC) -Iinclude $(CPPFLAGS) $(CFLAGS_ALL) -std=c99 $< -o $@ -L$(OUT) -llocus -Wl,-rpath,'$$ORIGIN/../..' $(LDFLAGS_ALL) -lm
gpu-check-here: $(SHARED_CUDA) $(OUT)/tests/gpu/cuda $(OUT)/tests/emulated/count $(EMULATED)/liblocus_cuda.so.$(SOVERSION) \
    $(OUT)/tests/stale/liblocus_cuda.so.$(SOVERSION) $(BENCH_PROGRAM)
	@NVCC=$(NVCC) tools/gpu_check.sh $(OUT)

# What the solver would do on the gpu.* inputs, counted on the emulated device.
$(OUT)/tests/emulated/count: $(EMULATED)/count.cpp.o $(EMULATED)/device.cpp.o $(OUT)/tests/bench/data/volumes.cpp.o $(OUT)/tests/bench/data/scans.cpp.o $(LIB_STATIC)
	@$(CXX) $^ $(LDFLAGS_ALL) -o $@
cuda-count: $(OUT)/tests/emulated/count ## rounds, visits and bytes of the CUDA solver, counted without a GPU; SIDE=256 for larger cubes
	@$< $(SIDE)

# The tables of docs/cuda.md, made anew.
.PHONY: cuda-document
cuda-document: $(CUDA_OBJECTS) $(OUT)/tests/emulated/count ## renew the tables of docs/cuda.md: minutes
	@tools/ptxas_table.sh $(CUDA_OBJECTS:.o=.ptxas) | grep -v '| sm_80 |' >$(OUT)/cuda/kernels.md
	@$(OUT)/tests/emulated/count 256 >$(OUT)/cuda/counts.md
	@awk -F ' *[|] *' -f tools/tables.awk $(OUT)/cuda/kernels.md $(OUT)/cuda/counts.md docs/cuda.md >$(OUT)/cuda/document.md
	@cp $(OUT)/cuda/document.md docs/cuda.md
