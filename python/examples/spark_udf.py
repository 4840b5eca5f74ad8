"""A UDF of Spark on a local cluster: pandas hands whole columns over. Needs Java 17.

    pip install unitvec "pyspark[sql]"
    python spark_udf.py 1_000_000
"""

import sys

import numpy as np
import pandas as pd
from pyspark.sql import SparkSession
from pyspark.sql.functions import col, cos, lit, pandas_udf, sin

import unitvec


def oct32p(x: pd.Series, y: pd.Series, z: pd.Series) -> pd.Series:
    # Spark has no unsigned integers: a code of 32 bits needs a long.
    vectors = np.stack([x, y, z], axis=-1)
    return pd.Series(unitvec.encode(vectors, "oct32p", threads=1).astype("int64"))


def main(count: int) -> None:
    spark = SparkSession.builder.master("local[2]").config("spark.ui.enabled", "false").getOrCreate()
    encode = pandas_udf(oct32p, "long")
    rows = spark.range(count).select(encode(sin(col("id")), cos(col("id")), lit(1.0)).alias("code"))
    print(rows.count(), "rows,", rows.distinct().count(), "codes")
    spark.stop()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
