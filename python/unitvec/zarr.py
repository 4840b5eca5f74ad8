"""Zarr 3: arrays of directions, stored as one unsigned integer each.

>>> import zarr
>>> from unitvec.zarr import Unitvec
>>> normals = zarr.create_array(
...     {}, shape=(1000, 3), chunks=(100, 3), dtype="float32", filters=[Unitvec("oct32p")]
... )

The last axis, of 3 floats, is dropped in the store. Readers need this package; its entry point names the codec to Zarr.
Install both with ``pip install unitvec[zarr]``.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from zarr.abc.codec import ArrayArrayCodec
from zarr.dtype import UInt8, UInt16, UInt32, UInt64

import unitvec

__all__ = ["Unitvec"]

# By bytes.
_INTEGERS = {1: UInt8(), 2: UInt16(), 4: UInt32(), 8: UInt64()}


@dataclass(frozen=True)
class Unitvec(ArrayArrayCodec):
    """Encodes float32 or float64 of shape (..., 3) to unsigned integers of shape (...), in chunks of any number of directions.

    Zeros, NaN and infinite vectors become the codec's null code, which decodes to the array's fill value: zeros, or NaN.
    Chunks are encoded on one thread each; Zarr runs several at a time.

    :param codec: a name of `unitvec.codecs()` with a null code. Frames and rotations have none.
    :param max_error_deg: the bound on the error in degrees. It stands in the metadata for readers and is set by `codec`.
    :raises ValueError: a wrong name, no null code, or an array of another shape, dtype or fill value.
    """

    codec: str = "oct32p"
    max_error_deg: float | None = None
    is_fixed_size = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "max_error_deg", max(unitvec._with_null(self.codec).max_errors_deg))

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Unitvec:
        return cls(**data.get("configuration", {}))

    def to_dict(self) -> dict[str, Any]:
        return {"name": "unitvec", "configuration": {"codec": self.codec, "max_error_deg": self.max_error_deg}}

    def validate(self, *, shape: tuple[int, ...], dtype: Any, chunk_grid: Any) -> None:
        self._check(shape, dtype)

    def resolve_metadata(self, chunk_spec: Any) -> Any:
        self._check(chunk_spec.shape, chunk_spec.dtype)
        fill = chunk_spec.fill_value
        if not (fill == 0 or np.isnan(fill)):
            raise ValueError(f"the fill value is 0 or NaN, which stand for no direction, not {fill}")
        facts = unitvec.codec(self.codec)
        dtype, null = _INTEGERS[facts.dtype.itemsize], facts.dtype.type(facts.null)
        return replace(chunk_spec, shape=chunk_spec.shape[:-1], dtype=dtype, fill_value=null)

    def compute_encoded_size(self, input_byte_length: int, chunk_spec: Any) -> int:
        vector = 3 * chunk_spec.dtype.to_native_dtype().itemsize
        return input_byte_length // vector * unitvec.codec(self.codec).dtype.itemsize

    def _check(self, shape: tuple[int, ...], dtype: Any) -> None:
        unitvec._check_floats(dtype.to_native_dtype(), unitvec.codec(self.codec))
        if not shape or shape[-1] != 3:
            raise ValueError(f"arrays and chunks of directions have a last axis of 3, not the shape {shape}")

    def _encode_sync(self, chunk_data: Any, chunk_spec: Any) -> Any:
        codes = unitvec.encode(chunk_data.as_numpy_array(), self.codec, null=True, threads=1)
        return chunk_spec.prototype.nd_buffer.from_numpy_array(codes)

    def _decode_sync(self, chunk_data: Any, chunk_spec: Any) -> Any:
        codes = chunk_data.as_numpy_array()
        vectors = unitvec.decode(codes, self.codec, null=True, threads=1)
        if np.isnan(chunk_spec.fill_value):
            vectors[codes == unitvec.codec(self.codec).null] = np.nan
        vectors = vectors.astype(chunk_spec.dtype.to_native_dtype(), copy=False)
        return chunk_spec.prototype.nd_buffer.from_numpy_array(vectors)

    async def _encode_single(self, chunk_data: Any, chunk_spec: Any) -> Any:
        return await asyncio.to_thread(self._encode_sync, chunk_data, chunk_spec)

    async def _decode_single(self, chunk_data: Any, chunk_spec: Any) -> Any:
        return await asyncio.to_thread(self._decode_sync, chunk_data, chunk_spec)
