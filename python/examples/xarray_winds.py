"""Winds as a direction and a speed: 4 bytes and 2 in place of 12, in a dataset that xarray opens by itself.

    pip install unitvec[zarr] xarray
    python xarray_winds.py 1_000_000
"""

import sys
import tempfile

import numpy as np
import xarray

from unitvec.zarr import Unitvec


def main(count: int) -> None:
    wind = np.random.default_rng(1).normal(0, 8, (count, 3)).astype("float32")
    wind[0] = 0  # A calm has no direction.
    speed = np.linalg.norm(wind, axis=1)
    direction = wind / np.where(speed == 0, 1, speed)[:, None]
    winds = xarray.Dataset({"direction": (("station", "axis"), direction), "speed": ("station", speed)})
    encoding = {
        "direction": {"filters": [Unitvec("oct32p")], "chunks": (min(count, 1_000_000), 3), "fill_value": 0.0},
        "speed": {"dtype": "uint16", "scale_factor": 0.01, "_FillValue": 0xFFFF},
    }
    with tempfile.TemporaryDirectory() as folder:
        winds.to_zarr(folder, encoding=encoding, zarr_format=3, consolidated=True, mode="w")
        opened = xarray.open_zarr(folder).load()
    back = opened.direction * opened.speed
    print(opened)
    print(f"largest change of a wind: {float(np.abs(back - wind).max()):.4f} m/s; the calm: {back[0].values}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
