// Runs kernel number argv[1] of KERNELS, over as many elements as argv[2] says: words from the standard input, results to the
// standard output.

#include <stdio.h>
#include <stdlib.h>
#include <vector>

int main(int count, char** arguments) {
    if (count != 3) return 2;
    const Kernel& chosen = KERNELS[atoi(arguments[1])];
    const uint elements = static_cast<uint>(atoi(arguments[2]));
    std::vector<uint> words(elements * chosen.read), results(elements * chosen.written);
    if (fread(words.data(), sizeof(uint), words.size(), stdin) != words.size()) return 3;
    for (uint i = 0; i < elements; ++i) chosen.run(words.data(), results.data(), elements, i);
    return fwrite(results.data(), sizeof(uint), results.size(), stdout) == results.size() ? 0 : 4;
}
