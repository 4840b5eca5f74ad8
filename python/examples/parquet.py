"""Normals in Parquet: a FixedSizeList of 3 floats, read without a copy, becomes a column of unsigned integers.

    pip install unitvec pyarrow
    python parquet.py 1_000_000
"""

import os
import sys
import tempfile

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import unitvec


def main(count: int) -> None:
    normals = np.random.default_rng(1).normal(size=(count, 3)).astype("float32")
    column = pa.FixedSizeListArray.from_arrays(pa.array(normals.reshape(-1)), 3)
    with tempfile.TemporaryDirectory() as folder:
        floats, codes = (os.path.join(folder, name) for name in ["floats.parquet", "codes.parquet"])
        pq.write_table(pa.table({"normal": column}), floats)
        # The codec's name goes into the metadata of the field, for readers.
        field = pa.field("normal", pa.uint32(), metadata={"unitvec": "oct32p"})
        encoded = pa.array(unitvec.encode(column, "oct32p"))
        pq.write_table(pa.table([encoded], schema=pa.schema([field])), codes, use_dictionary=False)
        read = pq.read_table(codes)
        back = unitvec.decode(read["normal"], read.schema.field("normal").metadata[b"unitvec"].decode())
        sizes = [os.path.getsize(path) for path in (floats, codes)]
    # Back to Arrow, again without a copy.
    vectors = pa.FixedSizeListArray.from_arrays(pa.array(back.reshape(-1)), 3)
    print(f"{len(vectors)} normals: {sizes[0]} bytes as floats, {sizes[1]} as codes")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
