"""numcodecs: a filter for Zarr's format 2, and for whatever else takes these codecs.

>>> from unitvec.numcodecs import Unitvec
>>> Unitvec("oct16p").get_config()["id"]
'unitvec'

Readers need this package; its entry point names the codec to numcodecs. Install both with ``pip install unitvec[numcodecs]``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numcodecs.abc import Codec
from numcodecs.compat import ensure_contiguous_ndarray, ensure_ndarray, ndarray_copy

import unitvec

__all__ = ["Unitvec"]


class Unitvec(Codec):
    """Encodes floats of shape (..., 3) to unsigned integers of shape (...). Buffers without a shape hold x, y, z in turn.

    Vectors without a direction (zeros, NaN, infinite ones) become the codec's null code and come back as zeros. So 0 is the
    fill value to take.

    :param codec: a name of `unitvec.codecs()` with a null code. Frames and rotations have none.
    :param dtype: of the floats, in and out: float32 or float64.
    :param max_error_deg: the bound on the error in degrees. It stands in the metadata for readers and is set by `codec`.
    :raises ValueError: a wrong name or dtype, no null code, or an array of another shape, dtype or order.
    """

    codec_id = "unitvec"

    def __init__(self, codec: str = "oct32p", dtype: Any = "<f4", max_error_deg: float | None = None) -> None:
        facts, floats = unitvec._with_null(codec), np.dtype(dtype)
        unitvec._check_floats(floats, facts)
        self.codec, self.dtype, self.max_error_deg = codec, floats.str, max(facts.max_errors_deg)

    def encode(self, buf: Any) -> np.ndarray:
        """Codes of `buf`, in little endian."""
        array = ensure_ndarray(buf)
        if array.dtype != self.dtype:
            raise ValueError(f"this filter is for {self.dtype}, not {array.dtype.str}; give it the array's dtype")
        if array.flags.f_contiguous and not array.flags.c_contiguous:
            raise ValueError("the array is in Fortran order; create it with order='C'")
        if array.ndim == 1 and array.size % 3 == 0:
            array = array.reshape(-1, 3)
        codes = unitvec.encode(array, self.codec, null=True, threads=1)
        return codes.astype(codes.dtype.newbyteorder("<"), copy=False)

    def decode(self, buf: Any, out: Any = None) -> Any:
        """Floats of shape (n, 3), or written to `out`."""
        codes = ensure_contiguous_ndarray(buf).view(unitvec.codec(self.codec).dtype.newbyteorder("<"))
        vectors = unitvec.decode(codes, self.codec, null=True, threads=1)
        return ndarray_copy(vectors.astype(self.dtype, copy=False), out)
