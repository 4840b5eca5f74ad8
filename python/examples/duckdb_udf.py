"""A function of SQL in DuckDB: `oct32p(x, y, z)` encodes whole columns.

    pip install unitvec duckdb pyarrow
    python duckdb_udf.py 1_000_000
"""

import sys

import duckdb
import numpy as np
import pyarrow as pa

import unitvec


def oct32p(x: pa.ChunkedArray, y: pa.ChunkedArray, z: pa.ChunkedArray) -> pa.Array:
    vectors = np.stack([column.to_numpy() for column in (x, y, z)], axis=-1)
    return pa.array(unitvec.encode(vectors, "oct32p", threads=1))


def main(count: int) -> None:
    database = duckdb.connect()
    database.create_function("oct32p", oct32p, ["FLOAT"] * 3, "UINTEGER", type="arrow")
    query = "SELECT oct32p(sin(i)::FLOAT, cos(i)::FLOAT, 1::FLOAT) AS code FROM range(?) AS t(i)"
    print(database.execute(f"SELECT count(*), count(DISTINCT code) FROM ({query})", [count]).fetchall())


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
