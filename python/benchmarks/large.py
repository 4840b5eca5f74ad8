"""How long many directions take: one core, Dask over processes, and both on paper. Prints the tables of docs/large.md.

    pip install unitvec[zarr] "dask[array,distributed]"
    python large.py 100_000_000
"""

import os
import sys
import tempfile
import time

import dask.array
import numpy as np
import zarr
from dask.distributed import Client, LocalCluster

import unitvec
from speed import least
from unitvec.zarr import Unitvec

CODECS = ["oct16p", "oct24p", "oct32p", "oct52p"]
CHUNK = 2_000_000


def one_core() -> dict[str, tuple[float, float]]:
    """Nanoseconds of processor time to encode and to decode a direction of a chunk, without Zarr."""
    vectors = np.random.default_rng(1).normal(size=(CHUNK, 3)).astype("float32")
    found = {}
    for codec in CODECS:
        codes = unitvec.encode(vectors, codec, null=True)
        back, given = np.empty_like(vectors), {"null": True, "threads": 1}
        encoding, decoding = least(
            lambda: unitvec.encode(vectors, codec, out=codes, **given),
            lambda: unitvec.decode(codes, codec, out=back, **given),
            clock=time.process_time,
        )
        found[codec] = encoding / CHUNK * 1e9, decoding / CHUNK * 1e9
    return found


def over_processes(count: int, workers: int) -> list[float]:
    """Seconds to make random directions; to make, encode and write them; and to read, decode and sum them."""
    vectors = dask.array.random.default_rng(1).normal(size=(count, 3), chunks=(CHUNK, 3)).astype("float32")
    cluster = LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
    with tempfile.TemporaryDirectory() as folder, cluster, Client(cluster):
        given = {"filters": [Unitvec("oct32p")], "compressors": None}
        store = zarr.create_array(folder, shape=vectors.shape, chunks=(CHUNK, 3), dtype="float32", **given)
        read = dask.array.from_zarr(store).sum()
        return least(
            vectors.sum().compute, lambda: dask.array.store(vectors, store, lock=False), read.compute
        )


def main(count: int) -> None:
    print(f"{os.cpu_count()} cores, NumPy {np.__version__}, Zarr {zarr.__version__}, Dask {dask.__version__}")
    core = one_core()
    print("\none core          encode, ns   decode, ns")
    for codec, (encoding, decoding) in core.items():
        print(f"{codec:<18}{encoding:10.2f}   {decoding:10.2f}")
    print(f"\n{count:.0e} by oct32p   make, s   make + write, s   read, s")
    for workers in [1, 2]:
        making, writing, reading = over_processes(count, workers)
        print(f"{workers} process{'es' if workers > 1 else '  '}      {making:9.2f} {writing:17.2f} {reading:9.2f}")
    print("\n1e10 on paper   bytes, GB   bound, degrees   encode on 1 core, s   on 64 cores, s")
    for codec, (encoding, _) in core.items():
        facts, seconds = unitvec.codec(codec), encoding * 10
        print(f"{codec:<12}{facts.dtype.itemsize * 10:13} {facts.max_errors_deg[0]:16.2g} {seconds:21.0f} {seconds / 64:16.2f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000_000)
