/* Memory that a device of the CUDA backend writes to: the driver's where there is a GPU, any where it is emulated. The
 * driver's functions are declared by hand: no header of CUDA is needed. */
#ifndef LOCUS_TESTS_DEVICE_MEMORY_H
#define LOCUS_TESTS_DEVICE_MEMORY_H

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef unsigned long long device_address;

static int (*driver_allocate)(device_address *, size_t);
static int (*driver_free)(device_address);
static int (*driver_download)(void *, device_address, size_t);
static int (*driver_finish)(void);

/* `function` becomes the driver's, or stays NULL. */
#define OF_DRIVER(driver, function, name)                                                                              \
    do {                                                                                                               \
        void *const found_ = dlsym(driver, name);                                                                      \
        memcpy(&(function), &found_, sizeof found_);                                                                   \
    } while (0)

/* Whether there is a GPU; its first one's context, which CUDA's runtime uses too, is the calling thread's then. */
static int have_driver(void) {
    static int looked = 0;
    int (*init)(unsigned), (*retain)(void **, int), (*use)(void *);
    void *context = NULL, *driver;
    if (looked++ > 0)
        return driver_allocate != NULL;
    driver = dlopen("libcuda.so.1", RTLD_NOW);
    if (driver == NULL)
        return 0;
    OF_DRIVER(driver, init, "cuInit");
    OF_DRIVER(driver, retain, "cuDevicePrimaryCtxRetain");
    OF_DRIVER(driver, use, "cuCtxSetCurrent");
    if (init == NULL || retain == NULL || use == NULL)
        return 0;
    if (init(0) != 0 || retain(&context, 0) != 0 || use(context) != 0) {
        printf("the driver gives no context\n");
        exit(2);
    }
    OF_DRIVER(driver, driver_allocate, "cuMemAlloc_v2");
    OF_DRIVER(driver, driver_free, "cuMemFree_v2");
    OF_DRIVER(driver, driver_download, "cuMemcpyDtoH_v2");
    OF_DRIVER(driver, driver_finish, "cuCtxSynchronize");
    return driver_allocate != NULL;
}

static void *device_memory(size_t bytes) {
    device_address address = 0;
    void *memory = NULL;
    if (!have_driver())
        memory = malloc(bytes);
    else if (driver_allocate(&address, bytes) == 0)
        memcpy(&memory, &address, sizeof memory);
    if (memory == NULL)
        exit(2);
    return memory;
}

static void device_free(void *memory) {
    device_address address = 0;
    memcpy(&address, &memory, sizeof memory);
    if (!have_driver())
        free(memory);
    else if (driver_free(address) != 0)
        exit(2);
}

/* Waits for all work of the device first, on whatever stream. */
static void from_device(void *to, const void *memory, size_t bytes) {
    device_address address = 0;
    memcpy(&address, &memory, sizeof memory);
    if (!have_driver())
        memcpy(to, memory, bytes);
    else if (driver_finish() != 0 || driver_download(to, address, bytes) != 0)
        exit(2);
}

#endif
