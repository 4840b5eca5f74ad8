"""Dithered codes: offsets by their formulas, and codes by octahedral positions in float64."""

import numpy as np
import pytest

import unitvec

RNG = np.random.default_rng(6)
NORMALS = RNG.normal(size=(40, 50, 3)).astype(np.float32)
SHAPE = NORMALS.shape[:-1]
WITH = [c.id for c in unitvec.codecs() if c.id.strip("0123456789p") in ("oct", "hemioct", "soct", "eaoct") and c.bits <= 33]


def mixed(x):
    """C. Wellons' lowbias32 of x + 0x9e3779b9."""
    x = (x + 0x9E3779B9) & 0xFFFFFFFF
    x = (x ^ x >> 16) * 0x7FEB352D & 0xFFFFFFFF
    x = (x ^ x >> 15) * 0x846CA68B & 0xFFFFFFFF
    return x ^ x >> 16


def offsets(keys):
    bits = mixed(keys.astype(np.uint64))
    halves = np.stack([bits & 0xFFFF, bits >> 16], axis=-1).astype(np.float64)
    return (halves + 0.5) / 65536 - 0.5


def test_offsets_come_from_keys():
    keys = RNG.integers(0, 1 << 32, SHAPE, np.uint64)
    pixels = RNG.integers(0, 1 << 32, (*SHAPE, 2), np.uint64)
    positions = RNG.normal(size=(*SHAPE, 3)).astype(np.float32)
    x, y, z = (positions.view(np.uint32)[..., axis].astype(np.uint64) for axis in range(3))
    for given, expected in (
        (keys, keys),
        (keys.astype(np.uint32), keys),
        (pixels, pixels[..., 0] ^ mixed(pixels[..., 1])),
        (positions, mixed(mixed(x) ^ y) ^ z),
    ):
        for name in ("oct16", "soct33"):
            codes = unitvec.encode(NORMALS, name, dither=given)
            np.testing.assert_array_equal(codes, unitvec.encode(NORMALS, name, dither=offsets(expected)))
            decoded = unitvec.decode(codes, name, dither=given, threads=1)
            np.testing.assert_array_equal(decoded, unitvec.decode(codes, name, dither=offsets(expected)))


def test_codes_round_the_moved_position():
    """x in the low byte, y in the high one, both of the octahedron's square in steps of 1/127."""
    moved_by = RNG.uniform(-0.5, 0.5, (*SHAPE, 2)).astype(np.float32)
    wide = NORMALS.astype(np.float64)
    x, y, z = np.moveaxis(wide / np.abs(wide).sum(axis=-1, keepdims=True), -1, 0)
    folded = (1 - np.abs(y)) * np.copysign(1, x), (1 - np.abs(x)) * np.copysign(1, y)
    square = np.where((z < 0)[..., None], np.stack(folded, -1), np.stack([x, y], -1)) * 127
    moved = np.clip(square + moved_by, -127, 127)
    clear = (np.abs(moved - np.floor(moved) - 0.5) > 1e-3).all(axis=-1)
    codes = unitvec.encode(NORMALS, "oct16", dither=moved_by)
    np.testing.assert_array_equal(codes.view(np.int8).reshape(*SHAPE, 2)[clear], np.rint(moved)[clear])
    assert clear.mean() > 0.99


@pytest.mark.parametrize("name", WITH)
def test_every_codec_with_dither(name):
    by, up = unitvec.codec(name), np.abs(NORMALS)
    keys = np.arange(up[..., 0].size).reshape(SHAPE)
    codes = unitvec.encode(up, name, dither=keys)
    decoded = unitvec.decode(codes, name, dither=keys).astype(np.float64)
    wide = up.astype(np.float64)
    chords = np.linalg.norm(decoded - wide / np.linalg.norm(wide, axis=-1, keepdims=True), axis=-1)
    # A clamped position is off by its offset; docs/dither.md has errors near those of plain codes.
    assert np.degrees(chords.max()) < 1.5 * by.max_errors_deg[0] and int(codes.max()) >> by.bits == 0
    # Precise encoders measure the distance of nearly equal neighbours in another way.
    fast, none = name.rstrip("p"), np.zeros((*SHAPE, 2))
    np.testing.assert_array_equal(unitvec.encode(up, fast, dither=none), unitvec.encode(up, fast))
    nulls = unitvec.encode(up * 0, name, dither=keys, null=True)
    assert (nulls == by.null).all() and not unitvec.decode(nulls, name, dither=keys, null=True).any()


@pytest.mark.parametrize(
    ("name", "keys", "reason"),
    [
        ("ico32", np.zeros(SHAPE, int), "ico32 has no dithered codes; oct8, oct8p,"),
        ("frame32", np.zeros(SHAPE, int), "no dithered codes"),
        ("tiles3d-oct16", np.zeros(SHAPE, int), "no dithered codes"),
        ("oct16", np.full(SHAPE, 1 << 32), "modulo"),
        ("oct16", np.full(SHAPE, -1), "modulo"),
        ("oct16", np.zeros(SHAPE), r"dither takes integers of shape \(40, 50\)"),
        ("oct16", np.zeros((*SHAPE, 3), int), "not int64 of shape"),
        ("oct16", "pixel", "not <U5 of shape"),
    ],
)
def test_other_keys_are_refused(name, keys, reason):
    elements = np.ones((*SHAPE, unitvec.codec(name).floats), np.float32)
    for refused in (lambda: unitvec.encode(elements, name, dither=keys), lambda: unitvec.decode(np.zeros(SHAPE, int), name, dither=keys)):
        with pytest.raises(ValueError, match=reason):
            refused()
