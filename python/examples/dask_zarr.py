"""Directions out of core: Dask makes them, two processes encode and write them to Zarr, and measure their mean error.

    pip install unitvec[zarr] "dask[array,distributed]"
    python dask_zarr.py 100_000_000
"""

import sys
import tempfile
import time

import dask.array
import zarr
from dask.distributed import Client, LocalCluster

import unitvec
from unitvec.zarr import Unitvec

CHUNK = 2_000_000


def main(count: int, workers: int) -> None:
    chunk = min(count, CHUNK)
    vectors = dask.array.random.default_rng(1).normal(size=(count, 3), chunks=(chunk, 3)).astype("float32")
    cluster = LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
    with tempfile.TemporaryDirectory() as folder, cluster:
        with Client(cluster):
            start = time.perf_counter()
            given = {"filters": [Unitvec("oct32p")], "compressors": None}
            store = zarr.create_array(folder, shape=vectors.shape, chunks=(chunk, 3), dtype="float32", **given)
            dask.array.store(vectors, store, lock=False)
            written = time.perf_counter()
            errors = vectors.map_blocks(unitvec.error, "oct32p", threads=1, drop_axis=1, dtype="float64")
            mean = errors.mean().compute()
            read = dask.array.from_zarr(store)[:, 2].mean().compute()
        print(f"{count} directions in {store.nbytes_stored()} bytes: written in {written - start:.1f} s by {workers} processes")
        print(f"mean error {mean:.6f} degrees, mean z {read:.4f}")


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    main(*given, *(100_000_000, 2)[len(given) :])
