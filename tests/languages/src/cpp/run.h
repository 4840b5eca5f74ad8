// Runs kernel number argv[1] of KERNELS, over as many elements as argv[2] says: words from the standard input, results to the
// standard output. CUDA and HIP run it on the device.

#include <stdio.h>
#include <stdlib.h>
#include <vector>

typedef unsigned int uint;
typedef void (*Function)(const uint* words, uint* results, const uint& count, uint i);

#ifdef __HIPCC__
#include <hip/hip_runtime.h>
#define cudaMalloc hipMalloc
#define cudaMemcpy hipMemcpy
#define cudaSuccess hipSuccess
#define cudaGetLastError hipGetLastError
#define cudaMemcpyHostToDevice hipMemcpyHostToDevice
#define cudaMemcpyDeviceToHost hipMemcpyDeviceToHost
#endif

#if defined(__CUDACC__) || defined(__HIPCC__)
template <Function function>
__global__ void each(const uint* words, uint* results, uint count) {
    function(words, results, count, blockIdx.x * blockDim.x + threadIdx.x);
}

template <Function function>
bool over(const std::vector<uint>& words, std::vector<uint>& results, uint count) {
    const size_t read = words.size() * sizeof(uint), written = results.size() * sizeof(uint);
    uint *from = nullptr, *to = nullptr;
    const bool is_there = cudaMalloc(&from, read) == cudaSuccess && cudaMalloc(&to, written) == cudaSuccess &&
                          cudaMemcpy(from, words.data(), read, cudaMemcpyHostToDevice) == cudaSuccess;
    if (is_there) each<function><<<(count + 255) / 256, 256>>>(from, to, count);
    return is_there && cudaGetLastError() == cudaSuccess &&
           cudaMemcpy(results.data(), to, written, cudaMemcpyDeviceToHost) == cudaSuccess;
}
#else
template <Function function>
bool over(const std::vector<uint>& words, std::vector<uint>& results, uint count) {
    for (uint i = 0; i < count; ++i) function(words.data(), results.data(), count, i);
    return true;
}
#endif

struct Kernel {
    bool (*run)(const std::vector<uint>&, std::vector<uint>&, uint);
    uint read, written;
};

#define KERNEL(function) over<function>

inline int run(const Kernel* kernels, int count, char** arguments) {
    if (count != 3) return 2;
    const Kernel& chosen = kernels[atoi(arguments[1])];
    const uint elements = static_cast<uint>(atoi(arguments[2]));
    std::vector<uint> words(elements * chosen.read), results(elements * chosen.written);
    if (fread(words.data(), sizeof(uint), words.size(), stdin) != words.size()) return 3;
    if (!chosen.run(words, results, elements)) return 5;
    return fwrite(results.data(), sizeof(uint), results.size(), stdout) == results.size() ? 0 : 4;
}

#define MAIN \
    int main(int count, char** arguments) { return run(KERNELS, count, arguments); }
