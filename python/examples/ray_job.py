"""A job of Ray: each task makes, encodes and measures a part.

    pip install unitvec ray
    python ray_job.py 10_000_000
"""

import sys

import numpy as np
import ray

import unitvec

PART = 1_000_000


@ray.remote
def total_error(seed: int, count: int) -> float:
    vectors = np.random.default_rng(seed).normal(size=(count, 3)).astype("float32")
    return unitvec.error(vectors, "oct32p", threads=1).sum()


def main(count: int) -> None:
    ray.init(num_cpus=2, include_dashboard=False)
    parts = [min(PART, count - start) for start in range(0, count, PART)]
    total = sum(ray.get([total_error.remote(seed, part) for seed, part in enumerate(parts)]))
    print(f"mean error of {count} directions: {total / count:.6f} degrees")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000)
