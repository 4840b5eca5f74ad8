"""Zarr and numcodecs: what comes back is what `unitvec.decode` gives for `unitvec.encode`, however the array is cut."""

import numpy as np
import pytest

import unitvec

zarr = pytest.importorskip("zarr", minversion="3")
numcodecs = pytest.importorskip("numcodecs")
from unitvec.numcodecs import Unitvec as Filter  # noqa: E402
from unitvec.zarr import Unitvec  # noqa: E402


def directions(*shape, dtype="float32"):
    return np.random.default_rng(1).normal(size=(*shape, 3)).astype(dtype)


def returned(vectors, codec):
    return unitvec.decode(unitvec.encode(vectors, codec, null=True), codec, null=True)


def create(vectors, codec="oct32p", store=None, **more):
    given = {"chunks": (16,) * (vectors.ndim - 1) + (3,), "filters": [Unitvec(codec)], "fill_value": 0, **more}
    return zarr.create_array({} if store is None else store, shape=vectors.shape, dtype=vectors.dtype, **given)


@pytest.mark.parametrize("codec", ["oct16p", "oct24p", "oct32p", "oct48p", "hemioct32p"])
@pytest.mark.parametrize("dtype", ["float32", "float64", ">f4"])
def test_round_trip(codec, dtype):
    vectors = directions(40, 20, dtype=dtype)
    array = create(vectors, codec, chunks=(16, 7, 3))
    array[:] = vectors
    assert array.dtype == np.dtype(dtype)
    np.testing.assert_array_equal(array[:], returned(vectors, codec))


def test_store_holds_codes():
    """A chunk is the codes in little endian: 4 bytes for each direction."""
    store, vectors = zarr.storage.MemoryStore(), directions(16)
    create(vectors, store=store, compressors=None)[:] = vectors
    chunk = store._store_dict["c/0/0"].to_bytes()
    assert chunk == unitvec.encode(vectors, "oct32p").astype("<u4").tobytes()


@pytest.mark.parametrize("sharded", [False, True])
def test_parts(sharded):
    """Parts read and written, with and without shards, are those of the array as a whole."""
    vectors = directions(64, 32)
    array = create(vectors, shards=(32, 32, 3) if sharded else None)
    array[:] = vectors
    expected = returned(vectors, "oct32p")
    for part in [np.s_[5], np.s_[3:40:7, 1:30], np.s_[..., 1], np.s_[63, 31, 2]]:
        np.testing.assert_array_equal(array[part], expected[part])
    array[10:20, 3:5] = vectors[:10, :2]
    expected[10:20, 3:5] = expected[:10, :2]
    np.testing.assert_array_equal(array[:], expected)


@pytest.mark.parametrize("sharded", [False, True])
@pytest.mark.parametrize("fill", [0, np.nan])
def test_fill_value(fill, sharded):
    """What was never written, and vectors without a direction, are the fill value, beside others in a chunk or not."""
    array = create(directions(64), fill_value=fill, shards=(32, 3) if sharded else None)
    array[3:5] = [[0, 0, 2], [0, 0, 0]]
    expected = np.full((64, 3), fill)
    expected[3] = [0, 0, 1]
    np.testing.assert_array_equal(array[:], expected)


def test_one_direction_and_none():
    for vectors in [directions(), directions(0)]:
        array = create(vectors, chunks=(*(1,) * (vectors.ndim - 1), 3))
        array[...] = vectors
        np.testing.assert_array_equal(array[...], returned(vectors, "oct32p"))


def test_consolidated_metadata(tmp_path):
    """The metadata of the group names the codec and bounds the error; the entry point opens it."""
    vectors = directions(20)
    group = zarr.create_group(tmp_path / "group")
    group.create_array("normals", shape=vectors.shape, dtype="float32", filters=[Unitvec("oct16p")])[:] = vectors
    zarr.consolidate_metadata(group.store)
    opened = zarr.open_consolidated(group.store)["normals"]
    said = opened.metadata.to_dict()["codecs"][0]
    bound = unitvec.codec("oct16p").max_errors_deg[0]
    assert said == {"name": "unitvec", "configuration": {"codec": "oct16p", "max_error_deg": bound}}
    np.testing.assert_array_equal(opened[:], returned(vectors, "oct16p"))


@pytest.mark.parametrize(
    "given, message",
    [
        ({"shape": (20, 4), "chunks": (16, 4)}, "last axis of 3"),
        ({"chunks": (16, 2)}, "last axis of 3"),
        ({"dtype": "int32"}, "float32 or float64, not int32"),
        ({"dtype": "float16"}, r"\.astype"),
        ({"fill_value": 1}, "0 or NaN"),
    ],
)
def test_wrong_arrays_are_refused(given, message):
    given = {"shape": (20, 3), "chunks": (16, 3), "dtype": "float32", **given}
    with pytest.raises(ValueError, match=message):
        zarr.create_array({}, filters=[Unitvec()], **given)[:] = 1


@pytest.mark.parametrize("kind", [Unitvec, Filter])
def test_wrong_codecs_are_refused(kind):
    with pytest.raises(ValueError, match="oct32p"):
        kind("oct32q")
    with pytest.raises(ValueError, match="no null code"):
        kind("latlong32")


@pytest.mark.parametrize("dtype", ["<f4", "<f8", ">f4"])
def test_format_2(dtype):
    vectors = directions(40, 20, dtype=dtype)
    vectors[3, 4] = 0
    given = {"chunks": (16, 7, 3), "filters": [Filter("oct24p", dtype)], "fill_value": 0, "zarr_format": 2}
    array = zarr.create_array({}, shape=vectors.shape, dtype=dtype, **given)
    array[:] = vectors
    np.testing.assert_array_equal(array[:], returned(vectors, "oct24p"))
    assert array.metadata.filters[0].get_config()["max_error_deg"] == unitvec.codec("oct24p").max_errors_deg[0]


def test_filter_by_itself():
    """The registry finds it; buffers without a shape and `out` serve."""
    codec = numcodecs.get_codec({"id": "unitvec", "codec": "oct32p"})
    assert codec == Filter() and numcodecs.get_codec(codec.get_config()) == codec
    vectors = directions(10)
    expected, out = returned(vectors, "oct32p"), np.empty((10, 3), "float32")
    for codes in [codec.encode(vectors), codec.encode(vectors.reshape(-1)).tobytes()]:
        np.testing.assert_array_equal(codec.decode(codes), expected)
    codec.decode(codec.encode(vectors), out)
    np.testing.assert_array_equal(out, expected)


@pytest.mark.parametrize(
    "array, message",
    [
        (np.ones((4, 3)), "not <f8"),
        (np.ones((4, 2), "float32"), r"\(\.\.\., 3\)"),
        (np.ones(4, "float32"), r"\(\.\.\., 3\)"),
        (np.asfortranarray(np.ones((4, 3), "float32")), "order='C'"),
    ],
)
def test_wrong_buffers_are_refused(array, message):
    with pytest.raises(ValueError, match=message):
        Filter().encode(array)
    with pytest.raises(ValueError, match="float32 or float64"):
        Filter(dtype="int32")
