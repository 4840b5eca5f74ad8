"""The codes and the decoded floats are those of the released vectors and of the program `unitvec`, bit for bit.

They need a checkout, and the program's path in UNITVEC_PROGRAM; `cargo xtask python` gives both.
"""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import unitvec

VECTORS = Path(os.environ.get("UNITVEC_VECTORS", Path(__file__).parents[2] / "vectors"))
PROGRAM = os.environ.get("UNITVEC_PROGRAM")
COUNT = int(os.environ.get("UNITVEC_COUNT", 1 << 14))


def floats(words):
    return np.array([[int(word, 16) for word in case.split()] for case in words], np.uint32).view(np.float32)


@pytest.mark.skipif(not VECTORS.exists(), reason="released vectors are in the repository, not in the package")
@pytest.mark.parametrize("name", [codec.id for codec in unitvec.codecs() if (VECTORS / f"{codec.id}.json").exists()])
def test_released_vectors(name):
    cases = json.loads((VECTORS / f"{name}.json").read_text())["cases"]
    # A third column is the decoded code; cases without it have a code that no encoder writes.
    encoded = [case for case in cases if case[0]]
    codes = unitvec.encode(floats([case[0] for case in encoded]), name)
    assert [f"{code:x}" for code in codes.tolist()] == [f"{int(case[1], 16):x}" for case in encoded]
    decoded = unitvec.decode(np.array([int(case[1], 16) for case in cases], unitvec.codec(name).dtype), name)
    np.testing.assert_array_equal(decoded.view(np.uint32), floats([case[2] for case in cases]).view(np.uint32))


def inputs(codec, count):
    """Random directions of random lengths, and after them any bits of floats."""
    rng = np.random.default_rng(5)
    values = rng.normal(size=(count, codec.floats)) * np.exp2(rng.integers(-20, 20, (count, 1)))
    values = values.astype(np.float32)
    bits = rng.integers(0, 1 << 32, (count // 4, codec.floats), np.uint64).astype(np.uint32)
    special = np.array([0, 0x80000000, 0x7F800000, 0xFF800000, 0x7FC00000, 1, 0x3F800000, 0xBF800000], np.uint32)
    some = rng.random(bits.shape) < 0.5
    bits[some] = rng.choice(special, int(some.sum()))
    values[: len(bits)] = bits.view(np.float32)
    return values


@pytest.mark.skipif(PROGRAM is None, reason="UNITVEC_PROGRAM is not set")
@pytest.mark.parametrize("codec", [*unitvec.codecs(), *unitvec.formats()], ids=lambda codec: codec.id)
def test_the_program_agrees(codec, tmp_path):
    values = inputs(codec, COUNT)
    values.astype("<f4").tofile(tmp_path / "in.bin")
    name, _, plain = codec.id.partition(" ")
    by = ["--codec", name]
    run = [PROGRAM, "encode", *by, *(["--plain"] if plain else []), "in.bin", "codes.dat"]
    subprocess.run(run, cwd=tmp_path, check=True, capture_output=True)
    subprocess.run([PROGRAM, "decode", *by, "codes.dat", "out.bin"], cwd=tmp_path, check=True, capture_output=True)
    packed = np.fromfile(tmp_path / "codes.dat", np.uint8).reshape(-1, codec.bytes)
    codes = unitvec.encode(values, codec.id)
    np.testing.assert_array_equal(codes.view(np.uint8).reshape(len(codes), -1)[:, : codec.bytes], packed)
    decoded = unitvec.decode(codes, codec.id)
    np.testing.assert_array_equal(decoded.view(np.uint32).ravel(), np.fromfile(tmp_path / "out.bin", "<u4"))


@pytest.mark.skipif(PROGRAM is None, reason="UNITVEC_PROGRAM is not set")
@pytest.mark.parametrize("limit", [3, 1, 0.65, 0.3, 0.06, 0.01, 0.003, 1e-4])
@pytest.mark.parametrize(
    ("flags", "given"),
    [
        ([], {}),
        (["--hemisphere"], {"domain": "hemisphere"}),
        (["--rotations"], {"element": "rotations"}),
        (["--frames"], {"element": "frames"}),
        (["--weights", "0,1"], {"weights": (0, 1)}),
        (["--weights", "2,1"], {"weights": (2, 1)}),
    ],
)
def test_the_program_chooses_the_same(limit, flags, given):
    run = subprocess.run([PROGRAM, "choose", "--max-error", str(limit), *flags, "--json", "-"], capture_output=True)
    found = [row["id"] for row in json.loads(run.stdout)["candidates"]]
    try:
        chosen = unitvec.choose(limit, **given).id
    except ValueError:
        chosen = None
    assert chosen == (found[0] if found else None)
