/* What emitted headers ask CUDA for, on the host: threads come one after the other. */
#include <cstdlib>
#include <cstring>
#define __CUDACC__
#define __host__
#define __device__
#define __global__
#define __forceinline__ inline
#define __launch_bounds__(threads)
#ifndef CARDS_MEMORY
#define CARDS_MEMORY (size_t)-1
#endif
enum { cudaMemcpyHostToDevice, cudaMemcpyDeviceToHost };
enum cudaError_t { cudaSuccess, cudaErrorMemoryAllocation = 2 };
#define cudaFree(at) (std::free(at), cudaSuccess)
#define cudaMemset(at, value, size) (std::memset(at, value, size), cudaSuccess)
#define cudaMemcpy(to, of, size, kind) (size ? (void)std::memcpy(to, of, size) : (void)0, cudaSuccess)
#define cudaGetLastError() cudaSuccess
#define cudaGetErrorString(error) (error == cudaErrorMemoryAllocation ? "out of memory" : "no error")
static inline cudaError_t cudaMalloc(void **at, size_t size)
{
    *at = size < CARDS_MEMORY ? std::malloc(size) : nullptr;
    return *at ? cudaSuccess : cudaErrorMemoryAllocation;
}
struct Index {
    unsigned x;
};
[[maybe_unused]] static Index blockIdx, threadIdx, blockDim = {128};
template <typename Kernel, typename... Given>
void launched(Kernel kernel, size_t n, Given... given)
{
    for (blockIdx.x = 0; blockIdx.x <= (n - 1)/blockDim.x; ++blockIdx.x) {
        for (threadIdx.x = 0; threadIdx.x < blockDim.x; ++threadIdx.x) {
            kernel(n, given...);
        }
    }
}
