"""Unit vectors, tangent frames and rotations in 8 to 64 bits, for NumPy arrays.

>>> import numpy as np, unitvec
>>> normals = np.array([[0.6, 0.0, -0.8], [0.0, 1.0, 0.0]])
>>> codes = unitvec.encode(normals, "oct32p")
>>> codes.dtype, codes.shape
(dtype('uint32'), (2,))
>>> unitvec.decode(codes, "oct32p")[1].tolist()
[0.0, 1.0, 0.0]

Codes are those of the Rust crate, the shaders and the program `unitvec`, bit for bit. `codecs()` and `formats()` list the
names. All functions release the GIL; nothing else may write their arrays meanwhile.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _native

__all__ = ["Codec", "choose", "codec", "codecs", "decode", "encode", "error", "formats", "snap"]
__version__ = _native.VERSION


class Codec(NamedTuple):
    """The facts of a codec, or of a format of other software."""

    id: str
    """Its name, as the functions take it."""
    element: str
    """``vectors``, ``frames`` or ``rotations``."""
    bits: int
    """Significant bits of a code, the low ones."""
    bytes: int
    """Bytes of a code in the files of the program ``unitvec``."""
    floats: int
    """Length of the last axis: 3 for vectors, 7 for frames (normal, tangent, handedness), 4 for rotations (x, y, z, w)."""
    domain: str
    """``sphere``, or ``hemisphere`` for directions with z >= 0."""
    max_errors_deg: list[float]
    """Upper bounds of the errors in degrees; of frames the normal's and the tangent's."""
    null: int | None
    """The code for vectors without a direction; ``None`` where there is none to spare."""
    mean_deg: float
    """Measured mean error in degrees, over 10^6 random directions; of frames the normal's. NaN for formats."""
    max_deg: float
    """Measured maximum error in degrees, likewise."""
    costs: list[float]
    """Costs of encoding and of decoding on a GPU (RDNA 2, by its compiler's estimate), as multiples of ``oct32``'s. NaN for formats."""
    is_unit: bool
    """True where decoded vectors have unit length; false for formats of components (``snorm…``)."""

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of an array of codes: the smallest unsigned integers that hold one."""
        return np.dtype(f"u{1 << (self.bytes - 1).bit_length()}")


def codec(name: str) -> Codec:
    """The facts of the codec or format of this name.

    :raises ValueError: there is none; similar names are in the message.
    """
    if not isinstance(name, str):
        raise ValueError(f"a codec is named by a str, as 'oct32p', not by {type(name).__name__}")
    return Codec(*_native.codec(name))


def codecs() -> list[Codec]:
    """All codecs, by family and width."""
    return [codec(name) for name in _native.names()[0]]


def formats() -> list[Codec]:
    """All formats of other software, as ``tiles3d-oct16`` or ``draco:10``: each with the encoder that finds the nearest code
    and, where the name ends in `` plain``, with that software's own rounding."""
    return [codec(name) for name in _native.names()[1]]


def choose(
    max_error: float, *, element: str = "vectors", domain: str = "sphere", weights: tuple[float, float] = (1.0, 1.0)
) -> Codec:
    """The codec of the fewest bytes whose error is never above `max_error` degrees. Of those the one that costs a GPU least, as
    `unitvec choose` of the program finds it; of equal ones the one of least mean error.

    :param domain: ``hemisphere`` where every direction has z >= 0.
    :param weights: weights of encoding and of decoding in the cost: (0, 1) for what is encoded once and decoded often.
    :raises ValueError: no codec is so fine, or there is no such element, domain or weight.

    >>> unitvec.choose(0.01).id
    'oct32'
    """
    found = [c for c in codecs() if c.element == element and c.domain in ("sphere", domain) and c.is_unit and c.max_deg > 0]
    if not found or domain not in ("sphere", "hemisphere"):
        raise ValueError(
            f"there are no {element!r} over a {domain!r}; elements are 'vectors', 'frames' and 'rotations', domains 'sphere'"
            " and 'hemisphere'"
        )
    if len(weights) != 2 or not all(0 <= weight < np.inf for weight in weights):
        raise ValueError(f"weights are two numbers from 0 on, of encoding and of decoding, not {weights!r}")
    finest = min(max(c.max_errors_deg) for c in found)
    if not max_error >= finest:
        raise ValueError(f"no codec of {element} is within {max_error} degrees; the finest reaches {finest}")

    def order(c: Codec) -> tuple[int, float, float]:
        cost = sum(weight * cost for weight, cost in zip(weights, c.costs) if weight)
        return c.bytes, cost if cost >= 0 else np.inf, c.mean_deg

    return min((c for c in found if max(c.max_errors_deg) <= max_error), key=order)


def encode(
    elements: Any, codec: str, *, null: bool = False, dither: Any = None, threads: int | None = None, out: np.ndarray | None = None
) -> np.ndarray:
    """Encodes vectors, frames or rotations to integers.

    :param elements: float32 or float64, of shape (..., 3) for vectors, (..., 7) for frames (normal, tangent, handedness of 1 or
        -1), (..., 4) for rotations (quaternions x, y, z, w). Lengths do not matter, but to codecs of components (``snorm…``) and ``vector…``. Lists, PyTorch's and JAX's arrays on the
        host and Arrow's FixedSizeList and FixedShapeTensor serve too. What is not contiguous is copied first. float64 is
        rounded to float32.
    :param codec: a name of `codecs()` or `formats()`.
    :param null: vectors without a direction (zeros, NaN, infinite ones) get the codec's null code. Else they get the code of +Z.
    :param dither: one key per vector, from which comes a small offset; `decode` needs the same. The errors of neighbours are then
        noise in place of bands. Integers of shape (...), as the indices of vertices, or (..., 2), as pixels: both from 0 to
        2^32 - 1; or floats of shape (..., 3), positions equal to the bit as float32, or (..., 2), the offsets themselves, in steps of
        the lattice, clamped to [-1/2, 1/2]. Only ``oct`` to 32 bits, ``hemioct``, ``soct`` and ``eaoct`` take it.
    :param threads: None for all cores, 1 for the calling thread.
    :param out: an array for the codes, which is returned.
    :returns: codes of shape (...), of the type `Codec.dtype`. Bits above `Codec.bits` are 0.
    :raises ValueError: a wrong name, shape, type or number of threads, or a codec without null code or dither.

    >>> keys = np.arange(2)
    >>> codes = unitvec.encode([[0.6, 0.0, -0.8], [0.0, 1.0, 0.0]], "oct16", dither=keys)
    >>> unitvec.decode(codes, "oct16", dither=keys).shape
    (2, 3)
    """
    by = _named(codec)
    flat, shape = _flat(elements, by)
    target, result = _output(out, shape, by.dtype, flat)
    options = (bool(null), _offsets(dither, shape), _threads(threads))
    _native.encode(by.id, flat, _bytes(target), options)
    return _filled(target, result)


def decode(
    codes: Any, codec: str, *, null: bool = False, dither: Any = None, threads: int | None = None, out: np.ndarray | None = None
) -> np.ndarray:
    """Decodes integers, as `encode` makes them.

    :param codes: integers of any type and shape (...). Each must fit into `Codec.bits`.
    :param codec: the name that they were encoded by.
    :param null: null codes become zeros. Else they become unit vectors like any other code.
    :param dither: the keys that they were encoded with. Others add up to a step of the lattice to the error.
    :param threads: None for all cores, 1 for the calling thread.
    :param out: an array for the elements, which is returned.
    :returns: float32 of shape (..., 3); of frames (..., 7), of rotations (..., 4).
    :raises ValueError: a wrong name, type, shape or number of threads, codes that do not fit, or a codec without null code or dither.
    """
    by = _named(codec)
    codes = _array(codes)
    if codes.dtype.kind not in "ui":
        raise ValueError(f"codes are integers, as {by.dtype} for {by.id}, not {codes.dtype}")
    limits = np.iinfo(codes.dtype)
    if codes.size and (limits.min < 0 or limits.max >> by.bits):
        beyond = next((int(code) for code in (codes.min(), codes.max()) if not 0 <= int(code) < 1 << by.bits), None)
        if beyond is not None:
            raise ValueError(f"{beyond} is no code of {by.id}, which has {by.bits} bits")
    # As they are, or copied where they have gaps or are of another type.
    flat = np.require(codes, by.dtype, ["C", "A"]).reshape(-1)
    target, result = _output(out, (*codes.shape, by.floats), np.dtype(np.float32), flat)
    options = (bool(null), _offsets(dither, codes.shape), _threads(threads))
    _native.decode(by.id, _bytes(flat), target, options)
    return _filled(target, result)


def error(elements: Any, codec: str, *, threads: int | None = None) -> np.ndarray:
    """The error of each element after encoding and decoding: in degrees, of axes (``axial…``) the angle between axes in
    degrees, of vectors with a length (``vector…``) relative to that length.

    :param elements: as `encode` takes them. float64 is rounded to float32 first.
    :returns: float64 of shape (...); of frames (..., 2): the normal's and the tangent's. NaN where there is no direction.
    :raises ValueError: as `encode` does.
    """
    by = _named(codec)
    flat, shape = _flat(elements, by)
    parts = len(by.max_errors_deg)
    errors = np.empty((*shape, parts) if parts > 1 else shape)
    _native.error(by.id, flat, errors.reshape(-1), _threads(threads))
    return errors


def snap(elements: Any, codec: str, *, threads: int | None = None, out: np.ndarray | None = None) -> np.ndarray:
    """Moves vectors, frames or rotations a little, so that other software, which rounds them to the format of this name, writes the
    nearest codes that it can. With a codec, it moves them to where the codec decodes them to.

    :param elements: as `encode` takes them. What has no direction stays as it is.
    :param out: an array for the result, which is returned.
    :returns: float32 of the same shape.
    :raises ValueError: as `encode` does; and for codecs of axes and of vectors with a length.

    >>> rotations = np.array([[0.1, 0.2, 0.3, 0.927]])
    >>> moved = unitvec.snap(rotations, "sog")
    >>> unitvec.error(rotations, "sog plain")[0] > 1.5 * unitvec.error(rotations, "sog")[0]
    True
    """
    by = _named(codec)
    flat, shape = _flat(elements, by)
    target, result = _output(out, (*shape, by.floats), np.dtype(np.float32), flat)
    _native.snap(by.id, flat, target, _threads(threads))
    return _filled(target, result)


def _named(name: Any) -> Codec:
    return name if isinstance(name, Codec) else codec(name)


def _array(values: Any) -> np.ndarray:
    if isinstance(values, np.ndarray):
        return values
    if type(values).__module__.partition(".")[0] == "pyarrow":
        return _of_arrow(values)
    try:
        return np.asarray(values)
    except (TypeError, ValueError, RuntimeError) as reason:
        raise ValueError(f"{type(values).__name__} gives no array: {reason}; copy it to the host's memory first") from reason


def _of_arrow(values: Any) -> np.ndarray:
    """The array of a column of Arrow, without a copy."""
    if hasattr(values, "combine_chunks"):
        values = values.combine_chunks()
    if values.null_count:
        raise ValueError(f"{values.null_count} values of the column are null; fill or drop them first")
    if hasattr(values, "to_numpy_ndarray"):
        return np.asarray(values.to_numpy_ndarray())
    size = getattr(values.type, "list_size", None)
    numbers = values if size is None else values.flatten()
    if numbers.null_count:
        raise ValueError(f"{numbers.null_count} components of the column are null; fill or drop them first")
    array = np.asarray(numbers.to_numpy(zero_copy_only=True))
    return array if size is None else array.reshape(-1, size)


def _flat(elements: Any, by: Codec) -> tuple[np.ndarray, tuple[int, ...]]:
    """The floats in one row, without gaps, in the machine's order of bytes; and the shape of the codes."""
    array = _array(elements)
    if not isinstance(elements, np.ndarray) and array.dtype.kind in "iu":
        array = array.astype(np.float64)
    _check_floats(array.dtype, by)
    if array.ndim == 0 or array.shape[-1] != by.floats:
        raise ValueError(f"{by.id} encodes {by.element} of shape (..., {by.floats}), not {array.shape}")
    return np.require(array, array.dtype.newbyteorder("="), ["C", "A"]).reshape(-1), array.shape[:-1]


def _check_floats(dtype: np.dtype[Any], by: Codec) -> None:
    if dtype.kind != "f" or dtype.itemsize not in (4, 8):
        raise ValueError(f"{by.id} encodes float32 or float64, not {dtype}; .astype('float32') makes them so")


def _offsets(dither: Any, shape: tuple[int, ...]) -> np.ndarray | None:
    """The offsets of dithered codes in one row."""
    if dither is None:
        return None
    keys = _array(dither)
    is_integer = keys.dtype.kind in "iu"
    widths = {shape: 1, (*shape, 2): 2} if is_integer else {(*shape, 2): 2, (*shape, 3): 3}
    if keys.dtype.kind not in "iuf" or keys.shape not in widths:
        raise ValueError(
            f"dither takes integers of shape {shape} or, for pixels, {(*shape, 2)}, or floats of shape {(*shape, 3)} for positions"
            f" or {(*shape, 2)} for offsets, not {keys.dtype} of shape {keys.shape}"
        )
    if is_integer and keys.size and not (0 <= int(keys.min()) and int(keys.max()) < 1 << 32):
        raise ValueError("keys of dither are integers from 0 to 2^32 - 1; take them modulo 2^32")
    flat = np.require(keys, np.uint32 if is_integer else np.float32, ["C", "A"]).reshape(-1)
    if not is_integer and widths[keys.shape] == 2:
        return flat
    offsets = np.empty(2 * int(np.prod(shape)), np.float32)
    _native.offsets(flat, widths[keys.shape], offsets)
    return offsets


def _with_null(name: str) -> Codec:
    """The codec of this name, for stores, which fill what was never written."""
    found = codec(name)
    if found.null is None:
        raise ValueError(f"{name} has no null code for fill values; take another, as 'oct32p'")
    return found


def _output(
    out: Any, shape: tuple[int, ...], dtype: np.dtype[Any], source: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """A row without gaps to write to, and the array that it is to fill: itself where that can be."""
    if out is None:
        result = np.empty(shape, dtype)
        return result.reshape(-1), result
    if not isinstance(out, np.ndarray) or out.dtype != dtype or out.shape != shape:
        given = f"{out.dtype} of shape {out.shape}" if isinstance(out, np.ndarray) else type(out).__name__
        raise ValueError(f"out must be an array of {dtype} of shape {shape}, not {given}")
    if not out.flags.writeable:
        raise ValueError("out is read-only")
    direct = out.flags.c_contiguous and out.flags.aligned and not np.may_share_memory(out, source)
    return (out.reshape(-1) if direct else np.empty(out.size, dtype)), out


def _filled(target: np.ndarray, result: np.ndarray) -> np.ndarray:
    if not np.may_share_memory(target, result):
        result[...] = target.reshape(result.shape)
    return result


def _bytes(integers: np.ndarray) -> np.ndarray:
    return integers.view(np.uint8)


def _threads(threads: Any) -> int | None:
    if threads is None:
        return None
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or not 1 <= threads <= 1024:
        raise ValueError(f"threads is None for all cores or a number from 1 to 1024, not {threads!r}")
    return int(threads)
