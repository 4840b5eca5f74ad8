"""An expression of Polars that encodes a column of arrays, batch by batch of a lazy frame.

    pip install unitvec polars
    python polars_udf.py 1_000_000
"""

import sys

import numpy as np
import polars as pl

import unitvec


def oct32p(normals: pl.Series) -> pl.Series:
    return pl.Series(normals.name, unitvec.encode(normals.to_numpy(), "oct32p"))


def main(count: int) -> None:
    normals = np.random.default_rng(1).normal(size=(count, 3)).astype("float32")
    frame = pl.DataFrame({"normal": pl.Series(normals, dtype=pl.Array(pl.Float32, 3))}).lazy()
    codes = frame.select(pl.col("normal").map_batches(oct32p, return_dtype=pl.UInt32, is_elementwise=True))
    print(codes.collect())


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
