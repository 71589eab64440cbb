// The table that liblocus uses: a device, its memory and its kernels.
#include "cuda/staging.cuh"
#include "graph/device/transfer.hpp"

#include <new>

namespace locus::cuda {
namespace {

using device::Kernel;
using device::Machine;
using device::Table;

// The CUDA device of a thread belongs to the program that calls us: it is as before after each call.
class OnDevice {
public:
    explicit OnDevice(int device) {
        if (cudaGetDevice(&before_) != cudaSuccess)
            before_ = -1;
        error_ = before_ == device ? cudaSuccess : cudaSetDevice(device);
        changed_ = before_ >= 0 && before_ != device;
    }
    ~OnDevice() {
        if (changed_)
            cudaSetDevice(before_);
        cudaGetLastError(); // what nobody asked for is not told to the next call
    }
    OnDevice(const OnDevice &) = delete;
    OnDevice &operator=(const OnDevice &) = delete;
    cudaError_t error() const { return error_; }

private:
    int before_ = -1;
    bool changed_ = false;
    cudaError_t error_;
};

int32_t describe(int device, Machine *machine, Message *why) {
    cudaDeviceProp properties;
    LOCUS_CUDA(cudaGetDeviceProperties(&properties, device));
    std::snprintf(machine->name, sizeof machine->name, "%s", properties.name);
    machine->memory = properties.totalGlobalMem;
    machine->multiprocessors = static_cast<uint32_t>(properties.multiProcessorCount);
    machine->compute = static_cast<uint32_t>(10 * properties.major + properties.minor);
    machine->block_memory = properties.sharedMemPerBlockOptin;
    machine->multiprocessor_memory = properties.sharedMemPerMultiprocessor;
    if (machine->compute < 80) {
        std::snprintf(why->text, sizeof why->text, "%s has compute capability %d.%d: 8.0 is the least", properties.name,
                      properties.major, properties.minor);
        return LOCUS_E_UNSUPPORTED;
    }
    return LOCUS_OK;
}

void close(Queue *queue) {
    if (queue == nullptr)
        return;
    if (queue->stream != nullptr) { // null: opening it failed
        const OnDevice here(queue->device);
        cudaStreamSynchronize(queue->stream);
        cudaFree(queue->scratch);
        release_staging(*queue);
        if (queue->own_stream)
            cudaStreamDestroy(queue->stream);
    }
    delete queue;
}

// Whether there is code for this GPU: the driver loads a kernel when something is asked of it.
int32_t probe(Queue &queue, Message *why) {
    const device::Resume<uint32_t> body{};
    Launch launch{};
    launch.kernel = Kernel::resume;
    launch.word_bits = 32;
    launch.body = &body;
    launch.body_bytes = sizeof body;
    uint64_t blocks = 0;
    return run_plain(queue, launch, why, &blocks);
}

// The device that is the calling thread's now.
int32_t start(Queue &queue, Machine *machine, Message *why) {
    int devices = 0;
    LOCUS_CUDA(cudaGetDeviceCount(&devices));
    if (devices == 0)
        return report(cudaErrorNoDevice, "cudaGetDeviceCount", why);
    LOCUS_CUDA(cudaGetDevice(&queue.device));
    const int32_t status = describe(queue.device, machine, why);
    if (status != LOCUS_OK)
        return status;
    queue.multiprocessors = static_cast<int>(machine->multiprocessors);
    LOCUS_CUDA(cudaStreamCreateWithFlags(&queue.stream, cudaStreamNonBlocking));
    queue.own_stream = true;
    return probe(queue, why);
}

int32_t open(Queue **queue, Machine *machine, Message *why) {
    *queue = nullptr;
    Queue *made = new (std::nothrow) Queue;
    if (made == nullptr) {
        std::snprintf(why->text, sizeof why->text, "the host has no more memory");
        return LOCUS_E_MEMORY;
    }
    const int32_t status = start(*made, machine, why);
    if (status != LOCUS_OK)
        close(made);
    else
        *queue = made;
    return status;
}

int32_t use_stream(Queue *queue, void *stream, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    LOCUS_CUDA(cudaStreamSynchronize(queue->stream));
    auto next = static_cast<cudaStream_t>(stream);
    if (stream == nullptr)
        LOCUS_CUDA(cudaStreamCreateWithFlags(&next, cudaStreamNonBlocking));
    if (queue->own_stream)
        cudaStreamDestroy(queue->stream);
    queue->stream = next;
    queue->own_stream = stream == nullptr;
    return LOCUS_OK;
}

int32_t allocate(Queue *queue, uint64_t bytes, void **memory, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    *memory = nullptr;
    const cudaError_t error = cudaMalloc(memory, bytes);
    if (error == cudaErrorMemoryAllocation) {
        cudaGetLastError();
        size_t left = 0, all = 0;
        cudaMemGetInfo(&left, &all);
        std::snprintf(why->text, sizeof why->text, "the GPU has %llu of %llu bytes left, and %llu are needed",
                      static_cast<unsigned long long>(left), static_cast<unsigned long long>(all),
                      static_cast<unsigned long long>(bytes));
        return LOCUS_E_MEMORY;
    }
    return report(error, "cudaMalloc", why);
}

// After a failure there may be work in the queue that uses the memory.
void release(Queue *queue, void *memory) {
    const OnDevice here(queue->device);
    cudaStreamSynchronize(queue->stream);
    cudaFree(memory);
}

int32_t upload(Queue *queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    if (bytes >= kStagingBytes && has_staging(*queue))
        return upload_staged(*queue, to, from, bytes, copy, why);
    LOCUS_CUDA(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, queue->stream)); // has read `from` on return
    return LOCUS_OK;
}

int32_t download(Queue *queue, void *to, const void *from, uint64_t bytes, const HostCopy *copy, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    if (bytes >= kStagingBytes && has_staging(*queue))
        return download_staged(*queue, to, from, bytes, copy, why);
    LOCUS_CUDA(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, queue->stream));
    LOCUS_CUDA(cudaStreamSynchronize(queue->stream));
    return LOCUS_OK;
}

// An address that the GPU does not know would end the process' whole context.
int32_t writable(Queue *queue, const void *memory, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    LOCUS_CUDA(cudaSetDevice(queue->device)); // without a context, which a new thread has none of, no memory is known
    cudaPointerAttributes about{};
    LOCUS_CUDA(cudaPointerGetAttributes(&about, memory));
    const bool elsewhere = about.type == cudaMemoryTypeDevice && about.device != queue->device;
    if (about.type != cudaMemoryTypeUnregistered && about.devicePointer != nullptr && !elsewhere)
        return LOCUS_OK;
    if (elsewhere)
        std::snprintf(why->text, sizeof why->text, "%p is memory of the CUDA device %d, and the diagram is on %d",
                      memory, about.device, queue->device);
    else
        std::snprintf(why->text, sizeof why->text, "%p is no memory that the GPU can write to", memory);
    return LOCUS_E_ARGUMENT;
}

int32_t run(Queue *queue, const Launch *launch, uint64_t *resident, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    switch (launch->kernel) {
    case Kernel::lower:
        return run_lower(*queue, *launch, why, resident);
    case Kernel::raise:
        return run_raise(*queue, *launch, why, resident);
    case Kernel::relax:
        return run_relax(*queue, *launch, why, resident);
    case Kernel::sibson:
    case Kernel::sibson_large:
        return run_sibson(*queue, *launch, why, resident);
    default:
        return run_plain(*queue, *launch, why, resident);
    }
}

int32_t launch(Queue *queue, const Launch *launched, Message *why) { return run(queue, launched, nullptr, why); }

int32_t resident(Queue *queue, const Launch *launched, uint64_t *blocks, Message *why) {
    return run(queue, launched, blocks, why);
}

int32_t compact(Queue *queue, const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    return cuda::compact(*queue, flags, count, list, listed, why);
}

int32_t finish(Queue *queue, Message *why) {
    const OnDevice here(queue->device);
    LOCUS_CUDA(here.error());
    LOCUS_CUDA(cudaStreamSynchronize(queue->stream));
    return LOCUS_OK;
}

constexpr Table table{sizeof(Table), device::kInterface, LOCUS_VERSION, open,   close,    use_stream, allocate, release,
                      upload,        download,           writable,      launch, resident, compact,    finish};

} // namespace
} // namespace locus::cuda

const locus::device::Table *LOCUS_DEVICE_ENTRY(void) noexcept { return &locus::cuda::table; }
