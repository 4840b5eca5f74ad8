"""What arrays the functions take and give, and what they refuse."""

import os
import threading

import numpy as np
import pytest

import unitvec

ALL = [*unitvec.codecs(), *unitvec.formats()]
NORMALS = np.random.default_rng(1).normal(size=(64, 3)).astype(np.float32)


def elements(codec, shape, rng):
    values = rng.normal(size=(*shape, codec.floats))
    # Formats of components keep lengths.
    values /= np.linalg.norm(values, axis=-1, keepdims=True)
    if codec.element == "frames":
        values[..., 6] = np.where(rng.random(shape) < 0.5, -1, 1)
    return values.astype(np.float32)


@pytest.mark.parametrize("codec", ALL, ids=lambda codec: codec.id)
def test_shapes_and_types_of_every_codec(codec):
    some = elements(codec, (2, 3, 5), np.random.default_rng(2))
    codes = unitvec.encode(some, codec.id)
    assert codes.dtype == codec.dtype and codes.shape == (2, 3, 5) and codec.dtype.itemsize >= codec.bytes
    assert codes.size == 0 or int(codes.max()) >> codec.bits == 0
    decoded = unitvec.decode(codes, codec.id)
    assert decoded.dtype == np.float32 and decoded.shape == some.shape
    for empty in ((0,), (2, 0)):
        assert unitvec.decode(unitvec.encode(elements(codec, empty, np.random), codec.id), codec.id).shape[:-1] == empty
    if codec.domain == "sphere" and codec.element == "vectors":
        errors = unitvec.error(some, codec.id)
        assert errors.shape == (2, 3, 5)
        assert "plain" in codec.id or float(errors.max()) <= codec.max_errors_deg[0]


def test_errors_are_angles():
    decoded = unitvec.decode(unitvec.encode(NORMALS, "oct16p"), "oct16p").astype(np.float64)
    exact = NORMALS.astype(np.float64)
    cosines = (decoded * exact).sum(axis=1) / np.linalg.norm(exact, axis=1) / np.linalg.norm(decoded, axis=1)
    np.testing.assert_allclose(unitvec.error(NORMALS, "oct16p"), np.degrees(np.arccos(cosines)), atol=1e-5)


def test_other_layouts_give_the_same_codes():
    expected = unitvec.encode(NORMALS, "oct32p")
    wide = np.zeros((64, 5), np.float32)
    wide[:, 1:4] = NORMALS
    unaligned = np.frombuffer(b"\0" + NORMALS.tobytes(), np.uint8)[1:].view(np.float32).reshape(-1, 3)
    read_only = NORMALS.copy()
    read_only.flags.writeable = False
    for other in (
        wide[:, 1:4],
        NORMALS[::-1][::-1],
        np.asfortranarray(NORMALS),
        NORMALS.astype(np.float64),
        NORMALS.astype(">f4"),
        NORMALS.astype(">f8"),
        NORMALS.tolist(),
        unaligned,
        read_only,
    ):
        np.testing.assert_array_equal(unitvec.encode(other, "oct32p"), expected)
    decoded = unitvec.decode(expected, "oct32p")
    for other in (expected.astype(">u4"), expected.astype(np.int64), expected.tolist(), np.repeat(expected, 2)[::2]):
        np.testing.assert_array_equal(unitvec.decode(other, "oct32p"), decoded)


def test_doubles_beyond_floats_keep_their_direction():
    far = np.array([[1e300, 0, -1e300], [0, 1e-300, 0]])
    near = np.array([[1, 0, -1], [0, 1, 0]], np.float32)
    np.testing.assert_array_equal(unitvec.encode(far, "oct32p"), unitvec.encode(near, "oct32p"))
    np.testing.assert_array_equal(unitvec.encode([[1, 0, -1]], "oct32p"), unitvec.encode(near[:1], "oct32p"))


def test_null_codes():
    some = np.array([[0, 0, 0], [np.nan, 1, 0], [0, 0, 1]], np.float32)
    for codec in ALL:
        if codec.element != "vectors" or codec.null is None:
            with pytest.raises(ValueError, match="no code to spare"):
                unitvec.encode(np.ones((1, codec.floats), np.float32), codec.id, null=True)
            continue
        codes = unitvec.encode(some, codec.id, null=True)
        assert codes[:2].tolist() == [codec.null] * 2 and codes[2] != codec.null
        decoded = unitvec.decode(codes, codec.id, null=True)
        assert not decoded[:2].any() and decoded[2].any()


def test_out():
    codes, decoded = np.empty(64, np.uint32), np.empty((64, 3), np.float32)
    assert unitvec.encode(NORMALS, "oct32p", out=codes) is codes
    assert unitvec.decode(codes, "oct32p", out=decoded) is decoded
    sparse = np.zeros((64, 2), np.uint32)
    unitvec.encode(NORMALS, "oct32p", out=sparse[:, 1])
    np.testing.assert_array_equal(sparse[:, 1], codes)
    # The codes over the first floats that they are made of.
    shared = NORMALS.copy()
    unitvec.encode(shared, "oct32p", out=shared.reshape(-1).view(np.uint32)[:64])
    np.testing.assert_array_equal(shared.reshape(-1).view(np.uint32)[:64], codes)
    codes.flags.writeable = False
    for wrong, reason in ((codes, "read-only"), (decoded, "uint32"), (sparse, "shape"), ([0] * 64, "list")):
        with pytest.raises(ValueError, match=reason):
            unitvec.encode(NORMALS, "oct32p", out=wrong)


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        (lambda: unitvec.encode(NORMALS, "oct99"), "did you mean oct"),
        (lambda: unitvec.encode(NORMALS, 7), "named by a str"),
        (lambda: unitvec.encode(NORMALS, "draco:99"), "2 to 16 bits"),
        (lambda: unitvec.encode(NORMALS[:, :2], "oct16"), r"shape \(\.\.\., 3\)"),
        (lambda: unitvec.encode(NORMALS, "frame32"), r"shape \(\.\.\., 7\)"),
        (lambda: unitvec.encode(np.float32(1), "oct16"), "shape"),
        (lambda: unitvec.encode(NORMALS.astype(int), "oct16"), "float32 or float64"),
        (lambda: unitvec.encode(NORMALS.astype(np.float16), "oct16"), "float32 or float64"),
        (lambda: unitvec.encode([[1, 2], [3]], "oct16"), "list gives no array|float32 or float64"),
        (lambda: unitvec.encode(NORMALS, "oct16", threads=0), "1 to 1024"),
        (lambda: unitvec.decode(NORMALS, "oct16"), "integers"),
        (lambda: unitvec.decode([1 << 16], "oct16"), "65536 is no code of oct16, which has 16 bits"),
        (lambda: unitvec.decode([-1], "oct16"), "-1 is no code"),
        (lambda: unitvec.decode(np.array([1 << 24], np.uint32), "oct24p"), "24 bits"),
        (lambda: unitvec.snap(NORMALS, "axial16"), "not for directions"),
        (lambda: unitvec.choose(0.0), "finest"),
        (lambda: unitvec.choose(float("nan")), "finest"),
        (lambda: unitvec.choose(1.0, element="axes"), "'vectors'"),
        (lambda: unitvec.choose(1.0, weights=(1, -1)), "from 0 on"),
    ],
)
def test_errors_say_what_to_do(wrong, reason):
    with pytest.raises(ValueError, match=reason):
        wrong()


def test_choose_takes_the_fewest_bytes():
    for limit in (3.0, 0.3, 0.01, 1e-4):
        chosen = unitvec.choose(limit)
        assert chosen.max_errors_deg[0] <= limit
        assert all(
            other.bytes >= chosen.bytes
            for other in unitvec.codecs()
            if other.element == "vectors" and other.domain == "sphere" and other.is_unit and other.max_errors_deg[0] <= limit
        )


def test_other_software_writes_snapped_elements_nearer():
    rng = np.random.default_rng(5)
    for name, part in (("sog", 0.55), ("quat10x3", 0.55), ("spz", 0.99), ("draco:8", 0.95), ("tiles3d-oct16", 0.95)):
        some = elements(unitvec.codec(name), (10, 100), rng)
        snapped = unitvec.snap(some, name)

        def off(given):
            written = unitvec.decode(unitvec.encode(given, f"{name} plain"), f"{name} plain").astype(np.float64)
            written /= np.linalg.norm(written, axis=-1, keepdims=True)
            return np.arccos(np.minimum(np.abs((written * some).sum(axis=-1)), 1))

        assert snapped.dtype == np.float32 and snapped.shape == some.shape
        assert off(snapped).mean() < part * off(some).mean()
    decoded = unitvec.decode(unitvec.encode(NORMALS, "oct16p"), "oct16p")
    for threads in (1, 2):
        np.testing.assert_array_equal(unitvec.snap(NORMALS, "oct16p", threads=threads), decoded)
    zeros = np.zeros((2, 3), np.float32)
    assert unitvec.snap(zeros, "oct16p", out=zeros) is zeros and not zeros.any()


def test_threads_change_nothing():
    many = np.random.default_rng(3).normal(size=(200_001, 3)).astype(np.float32)
    for name in ("oct24p", "oct32"):
        codes = unitvec.encode(many, name, threads=1)
        for threads in (None, 2, 7):
            np.testing.assert_array_equal(unitvec.encode(many, name, threads=threads), codes)
            np.testing.assert_array_equal(
                unitvec.decode(codes, name, threads=threads), unitvec.decode(codes, name, threads=1)
            )


def test_python_runs_while_it_encodes():
    many, done = np.ones((4_000_000, 3), np.float32), threading.Event()
    worker = threading.Thread(target=lambda: (unitvec.encode(many, "ico32", threads=1), done.set()))
    worker.start()
    turns = 0
    while not done.wait(0.0005):
        turns += 1
    worker.join()
    # With the lock held there would be one or two.
    assert turns > 5


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_works_without_threads():
    expected = unitvec.encode(NORMALS, "oct32p")
    child = os.fork()
    if child == 0:
        os._exit(0 if (unitvec.encode(NORMALS, "oct32p") == expected).all() else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_odd_arrays_do_no_harm():
    """10^5 arrays of odd shapes, strides, orders of bytes and values: each is encoded and decoded, or is a ValueError."""
    rng = np.random.default_rng(4)
    some = [codec for codec in ALL if codec.bits <= 64][:: max(1, len(ALL) // 60)]
    patterns = np.concatenate([rng.integers(0, 1 << 32, 4000, np.uint64).astype(np.uint32), np.zeros(96, np.uint32)])
    refused = 0
    for turn in range(100_000):
        codec = some[turn % len(some)]
        kind = ("<f4", ">f4", "<f8", ">f8", "<u2", ">i4", "<f2", "?", "O", "<U3")[int(rng.choice(10, p=[0.3, 0.2, 0.2, 0.1] + [1 / 30] * 6))]
        shape = tuple(int(n) for n in rng.integers(0, 4, int(rng.integers(0, 3))))
        last = codec.floats if rng.random() < 0.9 else int(rng.integers(0, 9))
        raw = rng.choice(patterns, 400).tobytes()
        size = int(np.prod((*shape, last)))
        if kind in ("O", "<U3"):
            array = np.full((*shape, last), "x", kind)
        else:
            array = np.frombuffer(raw, kind, size, offset=int(rng.integers(0, 8))).reshape(*shape, last)
        if rng.random() < 0.3:
            array = array[..., ::-1]
        if rng.random() < 0.2:
            array = np.broadcast_to(array, (2, *array.shape))
        out = None
        if rng.random() < 0.2:
            out = np.zeros(array.shape[:-1], codec.dtype if rng.random() < 0.8 else ">u2")[..., ::-1] if array.ndim > 1 else None
        try:
            codes = unitvec.encode(array, codec.id, null=rng.random() < 0.2, threads=1, out=out)
            odd = codes.astype(rng.choice(["<u8", ">u8", "<i8"])) if rng.random() < 0.5 else codes
            unitvec.decode(odd ^ odd.dtype.type(rng.random() < 0.1), codec.id, null=rng.random() < 0.2, threads=1)
            unitvec.snap(array, codec.id, threads=1)
        except ValueError as reason:
            refused += 1
            assert str(reason)
    assert 0 < refused < 60_000
