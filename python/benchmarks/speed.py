"""Times of encoding and decoding on one thread, side by side in one run on the same vectors, in ns a vector.

    python benchmarks/speed.py [--count 10000000] [--library libunitvec.so]

Beside `unitvec` it times an octahedral encoder of 16 bits in NumPy, DracoPy where it is installed, and with `--library` the C
library, whose function is a call of the Rust crate's slices.
"""

import argparse
import ctypes
import time

import numpy as np

import unitvec


def numpy_oct16(v):
    """Octahedral codes of 2 x 8 bits by rounding, as projects write it in NumPy."""
    v = v / np.abs(v).sum(axis=1, keepdims=True)
    folded = (1 - np.abs(v[:, 1::-1])) * np.where(v[:, :2] < 0, -1, 1)
    xy = np.where(v[:, 2:] < 0, folded, v[:, :2])
    return np.round(xy * 127).astype(np.int8)


def least(*functions, turns=5, clock=time.perf_counter):
    """The least seconds of each, in turn, so that none has a quieter machine."""
    times = [float("inf")] * len(functions)
    for _ in range(turns):
        for i, function in enumerate(functions):
            started = clock()
            function()
            times[i] = min(times[i], clock() - started)
    return times


def slices(library, codec, vectors, codes):
    """Encoding and decoding by the C library."""
    library.unitvec_find.restype = ctypes.c_void_p
    found = ctypes.c_void_p(library.unitvec_find(codec.id.encode()))
    count, size = ctypes.c_size_t(len(vectors)), ctypes.c_size_t(codes.nbytes)
    v, c = (ctypes.c_void_p(array.ctypes.data) for array in (vectors, codes))
    return [lambda: library.unitvec_encode(found, v, count, c, size), lambda: library.unitvec_decode(found, c, size, v, count)]


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--count", type=int, default=10_000_000)
    options.add_argument("--library")
    options = options.parse_args()
    vectors = np.random.default_rng(1).normal(size=(options.count, 3)).astype(np.float32)
    ns = 1e9 / options.count
    library = options.library and ctypes.CDLL(options.library)
    print("codec,encode ns,decode ns,encode of the C library,decode of the C library")
    for name in ("oct16", "oct16p", "oct32", "oct32p", "ico32"):
        codec = unitvec.codec(name)
        codes, decoded = unitvec.encode(vectors, name), np.empty_like(vectors)
        functions = [
            lambda: unitvec.encode(vectors, name, threads=1, out=codes),
            lambda: unitvec.decode(codes, name, threads=1, out=decoded),
        ]
        if library:
            functions += slices(library, codec, decoded, codes)
        print(",".join([name, *(f"{time * ns:.2f}" for time in least(*functions))]))
    [plain] = least(lambda: numpy_oct16(vectors), turns=2)
    print(f"NumPy by hand,{plain * ns:.2f}")
    try:
        import DracoPy
    except ImportError:
        return
    some = vectors[: options.count // 20]
    faces = np.arange(len(some) // 3 * 3, dtype=np.uint32).reshape(-1, 3)
    encode = lambda: DracoPy.encode(some, faces=faces, quantization_bits=8)
    [draco] = least(encode, turns=2)
    print(f"DracoPy (as positions),{draco * 1e9 / len(some):.2f}")


if __name__ == "__main__":
    main()
